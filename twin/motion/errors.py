"""Errors of motion planning.

MotionError
├── InvalidMotionError   the request makes no motion (a speed of zero, a number not finite)
├── PlanningError        the planner found no trajectory
└── UnsafePlanError      a plan leaves the limits on its way; says when and where
"""

from __future__ import annotations

from typing import ClassVar

from twin.errors import TwinError
from twin.joints import JointPosition
from twin.kinematics.errors import KinematicsError


class MotionError(TwinError):
    """A motion that cannot or must not be made."""

    code: ClassVar[str] = "motion"


class InvalidMotionError(MotionError):
    """The request does not describe a motion."""

    code: ClassVar[str] = "invalid_motion"
    remedy: ClassVar[str] = "Give finite positions and a speed greater than zero."


class PlanningError(MotionError):
    """The planner found no trajectory between two states."""

    code: ClassVar[str] = "planning_failed"
    remedy: ClassVar[str] = "Stop the robot and start the motion again from rest."


class UnsafePlanError(MotionError):
    """A plan leaves the workspace, a joint limit or comes near a singularity on its way.

    Attributes:
        time_s: When, seconds after the start of the plan.
        joints: Where.
        cause: What is wrong there.
    """

    code: ClassVar[str] = "unsafe_plan"
    remedy: ClassVar[str] = "Move to a pose nearer the middle of the workspace first."

    def __init__(self, time_s: float, joints: JointPosition, cause: KinematicsError) -> None:
        where = ", ".join(
            f"{name} = {value:.1f} mm"
            for name, value in zip(("rho1", "rho2", "rho3"), joints, strict=True)
        )
        super().__init__(
            f"{time_s:.2f} s into the motion, at {where}: {cause}",
            {"time_s": time_s, "cause": cause.code, **joints._asdict(), **cause.context},
        )
        self.time_s = time_s
        self.joints = joints
        self.cause = cause
