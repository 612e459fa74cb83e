"""The words in which the server speaks about the robot."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from enum import StrEnum
from typing import Literal

HolderKind = Literal["job", "jog", "homing", "calibration"]


class RobotMode(StrEnum):
    """What the robot is doing, seen from outside."""

    OFFLINE = "offline"  # no link to the motion board
    OFF = "off"  # drives are de-energised
    NOT_HOMED = "not_homed"  # drives on, position unknown
    HOMING = "homing"
    READY = "ready"  # at rest, may be moved
    MOVING = "moving"
    STOPPING = "stopping"
    STOPPED = "stopped"  # protective stop (category 2); reset continues
    EMERGENCY_STOP = "emergency_stop"  # latched; reset and homing continue
    FAULT = "fault"  # latched; see fault


class PlugState(StrEnum):
    """Where the plug is. Inserted and unknown allow no lateral motion, only withdrawal."""

    PARKED = "parked"
    FREE = "free"
    INSERTED = "inserted"
    UNKNOWN = "unknown"


@dataclass(frozen=True, slots=True)
class Holder:
    """Who has control of the robot."""

    kind: HolderKind
    name: str
    since: datetime
