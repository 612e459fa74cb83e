"""How the board's state and the server's own latches become one mode."""

from __future__ import annotations

from drivers.robot import BoardState, FaultCode, RobotState
from server.control.errors import (
    ControlError,
    EmergencyStoppedError,
    RobotFaultError,
    RobotNotReadyError,
    RobotOfflineError,
    RobotStoppedError,
)
from server.control.faults import words_for
from server.control.model import RobotMode

_FROM_BOARD = {
    BoardState.BOOT: RobotMode.OFF,
    BoardState.IDLE: RobotMode.OFF,
    BoardState.HOMING: RobotMode.HOMING,
    BoardState.RUN: RobotMode.MOVING,
    BoardState.STOPPING: RobotMode.STOPPING,
    BoardState.FAULT: RobotMode.FAULT,
}


def derive_mode(state: RobotState | None, *, stopped: bool, emergency: bool) -> RobotMode:
    """The mode that a person sees.

    Args:
        state: Newest telemetry, None while the link is down.
        stopped: A protective stop is in force.
        emergency: An emergency stop is in force.
    """
    if state is None:
        return RobotMode.OFFLINE
    if emergency or (state.fault and state.fault.code is FaultCode.EMERGENCY_STOP):
        return RobotMode.EMERGENCY_STOP
    if state.board is BoardState.FAULT:
        return RobotMode.FAULT
    if state.board is BoardState.STOPPING:
        return RobotMode.STOPPING
    if stopped:
        return RobotMode.STOPPED
    if state.board is BoardState.READY:
        return RobotMode.READY if state.homed else RobotMode.NOT_HOMED
    return _FROM_BOARD[state.board]


def why_not_moving(mode: RobotMode, state: RobotState | None) -> ControlError | None:
    """The error that stands in the way of any motion in this mode, or None."""
    match mode:
        case RobotMode.OFFLINE:
            return RobotOfflineError("The motion board does not answer.")
        case RobotMode.EMERGENCY_STOP:
            return EmergencyStoppedError("The emergency stop is latched.")
        case RobotMode.STOPPED | RobotMode.STOPPING:
            return RobotStoppedError("Somebody stopped the robot, and the stop is still in force.")
        case RobotMode.FAULT:
            if state is not None and state.fault is not None:
                return RobotFaultError(
                    f"{words_for(state.fault).title}: {state.fault.detail}",
                    fault=state.fault.code.value,
                )
            return RobotFaultError("The motion board reports a fault without a reason.")
        case RobotMode.OFF:
            return RobotNotReadyError("The drives are switched off.")
        case RobotMode.NOT_HOMED | RobotMode.HOMING:
            return RobotNotReadyError("The robot does not know its position yet.")
        case RobotMode.READY | RobotMode.MOVING:
            return None
