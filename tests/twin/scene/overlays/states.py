"""An instant in which everything is to be seen."""

from __future__ import annotations

import numpy as np

from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.scene import PlannedPath, TwinState
from twin.scene.poses import nominal_socket

_T = np.linspace(0.0, 4.0, 41)

PATH = PlannedPath(_T, np.column_stack([600 + 10 * _T**2, np.full(41, 300.0), np.full(41, 200.0)]))
"""4 s and 160 mm along x, faster and faster."""

EVERYTHING = TwinState(
    measured=JointPosition(180.0, 220.0, 90.0),
    commanded=JointPosition(190.0, 220.0, 100.0),
    force_n=70.0,
    plug="free",
    T_base_socket=nominal_socket(RobotGeometry()),
    socket_covariance_mm2=np.diag([0.04, 0.09, 0.25]),
    path=PATH,
)
