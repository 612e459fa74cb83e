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
from server.control.stop_cause import StopCause


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
    match state.board:
        case BoardState.FAULT:
            return RobotMode.FAULT
        case BoardState.STOPPING:
            return RobotMode.STOPPING
        case BoardState.RUN | BoardState.HOMING if stopped:
            return RobotMode.STOPPING  # the stop is on its way to the board
        case _ if stopped:
            return RobotMode.STOPPED
        case BoardState.BOOT | BoardState.IDLE:
            return RobotMode.OFF
        case BoardState.HOMING:
            return RobotMode.HOMING
        case BoardState.RUN:
            return RobotMode.MOVING
        case BoardState.READY:
            return RobotMode.READY if state.homed else RobotMode.NOT_HOMED


def why_not_moving(
    mode: RobotMode, state: RobotState | None, cause: StopCause | None = None
) -> ControlError | None:
    """The error that stands in the way of any motion in this mode, or None.

    Args:
        mode: What the robot is doing.
        state: The newest sample.
        cause: Why a protective stop is in force.
    """
    match mode:
        case RobotMode.OFFLINE:
            return RobotOfflineError("The motion board does not answer.")
        case RobotMode.EMERGENCY_STOP:
            return EmergencyStoppedError("The emergency stop is latched.")
        case RobotMode.STOPPED | RobotMode.STOPPING if cause is not None:
            return cause.as_error()
        case RobotMode.STOPPED:
            return RobotStoppedError("Somebody stopped the robot, and the stop is still in force.")
        case RobotMode.STOPPING:
            return RobotStoppedError("The robot is being stopped and has not come to rest yet.")
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


def why_fault_ends_motion(state: RobotState) -> ControlError | None:
    """The error that a fault in a sample means for the motion under way; None without a fault."""
    if state.fault is None:
        return None
    if state.fault.code is FaultCode.EMERGENCY_STOP:
        return EmergencyStoppedError(state.fault.detail)
    return why_not_moving(RobotMode.FAULT, state)


def why_not_preparing(
    mode: RobotMode, state: RobotState | None, cause: StopCause | None = None
) -> ControlError | None:
    """The error that stands in the way of switching the drives on or homing, or None."""
    if mode in {RobotMode.OFF, RobotMode.NOT_HOMED, RobotMode.HOMING}:
        return None
    return why_not_moving(mode, state, cause)
