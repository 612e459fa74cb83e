"""Looking at a whole motion before its first step."""

from __future__ import annotations

from server.control.errors import MotionOutOfReachError
from server.control.plug_guard import PlugGuard
from twin.errors import TwinError
from twin.geometry import RobotGeometry
from twin.motion import MotionPlan, check_plan

PATH_SAMPLES = 24


def check_path(geometry: RobotGeometry, plug: PlugGuard, plan: MotionPlan) -> None:
    """Do nothing if a motion is allowed along its whole length.

    Raises:
        LateralMotionForbiddenError: the plug forbids it.
        MotionOutOfReachError: it leaves the joint limits or the workspace.
    """
    step_s = plan.duration_s / PATH_SAMPLES
    waypoints = [plan.position_at(step_s * i) for i in range(1, PATH_SAMPLES + 1)]
    plug.check(plan.start.position, waypoints)
    try:
        check_plan(geometry, plan)
    except TwinError as error:
        raise MotionOutOfReachError(str(error)) from error
