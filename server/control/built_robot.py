"""The built robot between the server, which thinks in joints of the drawing, and its board.

Everything above plans and measures with the robot as drawn. Here each plan becomes the motion of
the board's joints that puts the built platform on the same way, and what the board reports comes
back as joints of the drawing. Without a calibration both are the same, to the last bit.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple, Self

import numpy as np

from drivers.robot import CommandedJoints, MeasuredJoints, RobotState
from server.control.errors import CalibrationUnusableError, MotionOutOfReachError
from twin.as_built import CorrectedPlan, JointCorrection, PlanarAsBuilt
from twin.geometry import RobotGeometry
from twin.joints import JointPosition, JointVelocity
from twin.kinematics import KinematicsError, singularity
from twin.motion import MotionLimits, MotionPlan, plan_segments
from twin.motion.check import LIMIT_TOLERANCE_MM
from twin.motion.segments import Segment

CHECK_PERIOD_S = 0.01
SLOWEST_SHARE = 0.5
"""Of the board's speed. A robot that must be slower than that is none like the drawn one."""
FURTHEST_OFF_MM = 60.0
"""A carriage of a robot like the drawn one is nowhere further from where the drawing has it."""
STANDS_SHARE = 0.9
"""Of the places where the drawn robot can stand, where the built one must."""
GAUGE_SHARE = 1.5
"""A force gauge that is off by more than this factor, either way, is broken, or its spring was
another one."""
_GRID = 12
"""Places along each carriage where the ratio of the speeds is looked at."""


class Step(NamedTuple):
    """The same piece of a motion twice.

    Attributes:
        drawn: In joints of the drawing.
        board: In joints of the board, which gets it.
    """

    drawn: Segment
    board: Segment


@dataclass(frozen=True, slots=True)
class BuiltRobot:
    """What is known of the built robot.

    Attributes:
        correction: Between the joints of drawing and board; None: built as drawn.
        speed_share: Of the board's speed limits that a plan may use: where the built carriage has
            to run faster than the drawn one, the board must still accept it.
        force_scale: Force that the board shows over the true one.
    """

    correction: JointCorrection | None = None
    speed_share: float = 1.0
    force_scale: float = 1.0

    @classmethod
    def of(
        cls, drawn: RobotGeometry, mechanism: PlanarAsBuilt | None, force_scale: float = 1.0
    ) -> Self:
        """The robot with a calibrated mechanism and force gauge, or as drawn without them.

        Raises:
            CalibrationUnusableError: no robot like the drawn one is built like that.
        """
        if not 1.0 / GAUGE_SHARE <= force_scale <= GAUGE_SHARE:  # also NaN
            raise CalibrationUnusableError(
                f"The slide would show {force_scale:.2f} times the true force. Look at the motor's "
                "current in the board's settings, and at the rate of the spring."
            )
        if mechanism is None:
            return cls(force_scale=force_scale)
        correction = JointCorrection(drawn, mechanism)
        speed_share = 1.0 / _fastest(correction)
        if not speed_share >= SLOWEST_SHARE:  # also NaN
            raise CalibrationUnusableError(
                "A robot with these numbers would have to move its carriages quite differently "
                "from the drawn one, or could not stand where that one can."
            )
        return cls(correction, min(1.0, speed_share), force_scale)

    def limits(self, of_board: MotionLimits) -> MotionLimits:
        """What motions are planned with."""
        return of_board if self.speed_share == 1.0 else of_board.scaled(self.speed_share)

    def seen(self, state: RobotState) -> RobotState:
        """A sample of the board in joints of the drawing, and in true newtons.

        Joints that belong to no pose of the robot, as before homing, stay as they are.
        """
        if self.force_scale != 1.0:
            state = replace(state, force_n=self.true_n(state.force_n))
        if self.correction is None:
            return state
        try:
            measured = self._seen(state.measured.position, state.measured.velocity)
            commanded = self._seen(state.commanded.position, state.commanded.velocity)
        except KinematicsError:
            return state
        return replace(
            state, measured=MeasuredJoints(*measured), commanded=CommandedJoints(*commanded)
        )

    def shown_n(self, true_n: float) -> float:
        """What the board shows, and compares with its limit, where this force acts."""
        return true_n * self.force_scale

    def true_n(self, shown_n: float) -> float:
        """The force where the board shows this one."""
        return shown_n / self.force_scale

    def tail(self, step: Step) -> tuple[JointPosition, JointVelocity]:
        """Where a step ends, and how fast, in joints of the drawing: exactly where the board does.

        The two segments of a step may part by a micrometre, and the board wants no jump.
        """
        return self._seen(step.board.end, step.board.end_velocity)

    def steps(self, plan: MotionPlan, segment_s: float) -> Iterator[Step]:
        """A plan cut into segments [s], those for the board beside those of the drawing."""
        drawn = plan_segments(plan, segment_s)
        board = drawn if self.correction is None else plan_segments(self._plan(plan), segment_s)
        return (Step(*pair) for pair in zip(drawn, board, strict=True))

    def check_travel(self, plan: MotionPlan) -> None:
        """Do nothing if the board's joints stay inside their travel all the way.

        Raises:
            MotionOutOfReachError: they do not.
        """
        if self.correction is None:
            return
        times_s = np.linspace(0.0, plan.duration_s, math.ceil(plan.duration_s / CHECK_PERIOD_S) + 1)
        joints_mm = self._plan(plan).sample(times_s).position_mm
        travel = self.correction.drawn.joint_ranges
        low_mm = np.array([one.min_mm for one in travel]) - LIMIT_TOLERANCE_MM
        high_mm = np.array([one.max_mm for one in travel]) + LIMIT_TOLERANCE_MM
        outside = ~((joints_mm >= low_mm) & (joints_mm <= high_mm))  # also where there is no pose
        if not outside.any():
            return
        moment, joint = np.argwhere(outside)[0]
        reached_mm = float(joints_mm[moment, joint])
        raise MotionOutOfReachError(
            f"As this robot is built, rho{joint + 1} would have to go to {reached_mm:.1f} mm, "
            f"beyond its travel from {travel[joint].min_mm:g} to {travel[joint].max_mm:g} mm.",
            joint=f"rho{joint + 1}",
        )

    def _plan(self, plan: MotionPlan) -> MotionPlan:
        return plan if self.correction is None else CorrectedPlan(plan, self.correction)

    def _seen(
        self, position: JointPosition, velocity: JointVelocity
    ) -> tuple[JointPosition, JointVelocity]:
        if self.correction is None:
            return position, velocity
        return (
            self.correction.from_board(position),
            self.correction.velocity_from_board(position, velocity),
        )


def _fastest(correction: JointCorrection) -> float:
    """The most that a carriage of the board moves while those of the drawing move by 1.

    Wherever a plan may go, with both moving as they please: the largest sum of a row of the rates.
    Infinite where the built robot can often not stand at all.
    """
    drawn = correction.drawn
    axes = [np.linspace(travel.min_mm, travel.max_mm, _GRID) for travel in (drawn.rho1, drawn.rho2)]
    rho = np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 2)
    joints = np.column_stack((rho, np.full(len(rho), drawn.rho3.min_mm)))
    measures = singularity.measures_many(drawn, joints)
    # NaN, where no pose exists, compares false
    regular = np.all(measures >= singularity.thresholds(singularity.SingularityLimits()), axis=1)
    joints = joints[regular]
    excess_mm = correction.to_board_many(joints)[:, :2] - joints[:, :2]
    stands = np.all(np.abs(excess_mm) < FURTHEST_OFF_MM, axis=1)  # NaN compares false
    if np.mean(stands) < STANDS_SHARE:
        return math.inf
    try:
        rates = correction.rates_many(joints[stands])
    except np.linalg.LinAlgError:  # a leg that lies across its rail
        return math.inf
    return float(np.max(np.abs(rates[:, :2, :2]).sum(axis=2)))
