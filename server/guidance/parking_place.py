"""Whether the robot stands where guidance is possible: at rest, free, in its parking place."""

from __future__ import annotations

import math

from server.config.park import ParkSettings
from server.control.model import PlugState, RobotMode
from server.control.supervisor import Supervisor
from server.guidance.model import PauseReason
from twin.kinematics import KinematicsError, gamma

NEAR_MM = 80.0
"""From farther off the camera, whose place is known anywhere, sees too little."""

SLIDE_MM = 3.0
"""A slide drawn back no further than this would stand in the car's way."""

_MOVES = {RobotMode.HOMING, RobotMode.MOVING, RobotMode.STOPPING}


def why_paused(supervisor: Supervisor, park: ParkSettings) -> PauseReason | None:
    """Why nobody can be guided in now, or None."""
    state = supervisor.telemetry.latest
    if state is None:
        return PauseReason.ROBOT_OFFLINE
    if supervisor.plug.state is PlugState.INSERTED:
        return PauseReason.PLUG_HELD
    if supervisor.holder is not None or supervisor.mode in _MOVES:
        return PauseReason.ROBOT_BUSY
    if not state.homed:
        return PauseReason.ROBOT_NOT_HOMED
    if supervisor.plug.state is PlugState.UNKNOWN:
        return PauseReason.PLUG_HELD
    joints = state.measured.position
    try:
        platform = gamma.platform(supervisor.geometry, joints)
    except KinematicsError:
        return PauseReason.ROBOT_NOT_HOMED
    away_mm = math.hypot(platform.x_mm - park.x_mm, platform.y_mm - park.y_mm)
    if away_mm > NEAR_MM or joints.rho3_mm > park.rho3_mm + SLIDE_MM:
        return PauseReason.ROBOT_NOT_PARKED
    return None
