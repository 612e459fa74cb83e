"""From the plan of a motion to the way of the plug's tip."""

from __future__ import annotations

import numpy as np

from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import KinematicsError, gamma
from twin.motion import MotionPlan
from twin.scene.state import PlannedPath

_SAMPLES = 81


class Way:
    """The way of the plug's tip for the plan that is followed, worked out once for each plan."""

    def __init__(self, geometry: RobotGeometry) -> None:
        self._geometry = geometry
        self._plan: MotionPlan | None = None
        self._path: PlannedPath | None = None

    def of(self, plan: MotionPlan | None) -> PlannedPath | None:
        """The path of a plan: the same object as long as it is the same plan."""
        if plan is not self._plan:
            self._plan = plan
            self._path = None if plan is None else planned_path(self._geometry, plan)
        return self._path


def planned_path(geometry: RobotGeometry, plan: MotionPlan) -> PlannedPath | None:
    """Where the tip goes; None if nothing moves, or the plan has joints without a pose."""
    if plan.duration_s <= 0:
        return None
    times_s = np.linspace(0.0, plan.duration_s, _SAMPLES)
    joints = plan.sample(times_s).position_mm
    try:
        tips = [gamma.forward(geometry, JointPosition(*map(float, row))) for row in joints]
    except KinematicsError:
        return None
    return PlannedPath(times_s, np.array(tips))
