"""The root of every error that the robot's mathematics raises.

TwinError
├── KinematicsError            twin.kinematics.errors
│   ├── UnreachableError       no joint positions within the limits put the tip there
│   ├── LegsCannotCloseError   no platform position belongs to these joint positions
│   └── NearSingularityError   the pose is too near a singularity
├── MotionError                twin.motion.errors
│   ├── InvalidMotionError     the request makes no motion (a speed of zero, a number not finite)
│   ├── PlanningError          the planner found no trajectory
│   └── UnsafePlanError        a plan leaves the limits on its way; says when and where
├── NoDesignError              twin.study.optimise: no robot within the bounds meets the demands
├── InvalidCovarianceError     twin.scene.overlays.spread: a matrix that is no covariance
└── WorkspaceError             twin.workspace.errors
    ├── EmptyWorkspaceError    the robot reaches no position at all
    ├── EmptyRegionError       a figure was asked of a region that has no points
    ├── InvalidRectangleError  the sizes or the place make no rectangle
    ├── InvalidGridError       the step makes no grid
    ├── RectangleOutsideError  a rectangle is not inside the workspace; says where it leaves it
    └── SingularRectangleError a rectangle touches a singularity, where the figure is infinite
"""

from __future__ import annotations

from typing import ClassVar


class TwinError(Exception):
    """The mathematics of the robot refuses a request; the message is a sentence for a person.

    Attributes:
        code: Stable name of the kind of error, for programs.
        remedy: What a person can do about it.
        context: Facts of this occurrence by name with unit.
    """

    code: ClassVar[str] = "twin_error"
    remedy: ClassVar[str] = "Look at the robot in the 3D view and try another target."

    def __init__(self, message: str, context: dict[str, float | str | None] | None = None) -> None:
        super().__init__(message)
        self.context: dict[str, float | str | None] = context or {}
