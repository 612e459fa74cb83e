"""What a motion board reports: one immutable sample after another."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from twin.joints import JointPosition, JointVelocity


class BoardState(StrEnum):
    """States of the motion board."""

    BOOT = "boot"  # starting, no configuration yet
    IDLE = "idle"  # drives off
    HOMING = "homing"  # looking for the limit switches
    READY = "ready"  # drives on, at rest
    RUN = "run"  # following segments
    STOPPING = "stopping"  # decelerating after a stop
    FAULT = "fault"  # latched: needs clear_fault()


class FaultCode(StrEnum):
    """Why a board latched a fault."""

    EMERGENCY_STOP = "emergency_stop"
    LIMIT_SWITCH = "limit_switch"
    FOLLOWING_ERROR = "following_error"
    STALL = "stall"
    QUEUE_UNDERRUN = "queue_underrun"
    HEARTBEAT_LOST = "heartbeat_lost"
    SEGMENT_MISMATCH = "segment_mismatch"
    HOMING_FAILED = "homing_failed"
    WATCHDOG = "watchdog"


@dataclass(frozen=True, slots=True)
class BoardFault:
    """A latched fault with the board's own words."""

    code: FaultCode
    detail: str


@dataclass(frozen=True, slots=True)
class LimitSwitches:
    """Switches at the start of each stroke; True means pressed (or its wire cut)."""

    rho1: bool
    rho2: bool
    rho3: bool


@dataclass(frozen=True, slots=True)
class MeasuredJoints:
    """What the board measured: step counters for rho1 and rho2, the encoder for rho3."""

    position: JointPosition
    velocity: JointVelocity


@dataclass(frozen=True, slots=True)
class CommandedJoints:
    """Where the segment that is being executed wants the joints to be."""

    position: JointPosition
    velocity: JointVelocity


SEGMENT_NUMBERS = 1 << 16
"""Segments are counted modulo this."""


@dataclass(frozen=True, slots=True)
class RobotState:
    """One telemetry sample.

    Attributes:
        sampled_at_s: When the board took the sample, on the host's clock (event loop time).
        received_at_s: When the host got it, on the same clock.
        board: State of the board.
        measured: Measured joint positions and velocities.
        commanded: Set point at the same instant.
        force_n: Force of the rho3 actuator along the insertion axis, from its motor current;
            positive when it pushes towards the car.
        enabled: Drives are energised.
        homed: Positions are valid: homed since the last reset and no step was lost since.
        switches: Limit switches.
        queue_free: Segments that can be pushed now.
        segments_done: Segments that the board has finished, or dropped by a stop, since the
            connection began, modulo SEGMENT_NUMBERS.
        fault: The latched fault, or None.
    """

    sampled_at_s: float
    received_at_s: float
    board: BoardState
    measured: MeasuredJoints
    commanded: CommandedJoints
    force_n: float
    enabled: bool
    homed: bool
    switches: LimitSwitches
    queue_free: int
    segments_done: int
    fault: BoardFault | None
