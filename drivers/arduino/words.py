"""What the board's numbers mean, in sentences."""

from __future__ import annotations

from drivers.arduino.protocol.messages import BoardKind, Fault, Refusal, State, TelemetryFlag
from drivers.robot import BoardFault, BoardState, FaultCode
from drivers.robot.segment_rules import JOINTS

STATES = {
    State.BOOT: BoardState.BOOT,
    State.IDLE: BoardState.IDLE,
    State.HOMING: BoardState.HOMING,
    State.READY: BoardState.READY,
    State.RUN: BoardState.RUN,
    State.STOPPING: BoardState.STOPPING,
    State.FAULT: BoardState.FAULT,
}

FAULTS = {
    Fault.EMERGENCY_STOP: FaultCode.EMERGENCY_STOP,
    Fault.LIMIT_SWITCH: FaultCode.LIMIT_SWITCH,
    Fault.FOLLOWING_ERROR: FaultCode.FOLLOWING_ERROR,
    Fault.STALL: FaultCode.STALL,
    Fault.QUEUE_UNDERRUN: FaultCode.QUEUE_UNDERRUN,
    Fault.HEARTBEAT_LOST: FaultCode.HEARTBEAT_LOST,
    Fault.SEGMENT_MISMATCH: FaultCode.SEGMENT_MISMATCH,
    Fault.HOMING_FAILED: FaultCode.HOMING_FAILED,
    Fault.WATCHDOG: FaultCode.WATCHDOG,
}

BOARD_NAMES = {BoardKind.ME_AURIGA: "Me Auriga"}

_REFUSALS = {
    Refusal.NONE: "it is not known whether the board obeyed, because messages were lost",
    Refusal.NOT_CONFIGURED: "the board is still starting",
    Refusal.DRIVES_OFF: "the drives are off; enable them first",
    Refusal.HOMING: "the robot is homing",
    Refusal.MOVING: "the robot is moving; stop it first",
    Refusal.STOPPING: "the robot is still stopping",
    Refusal.FAULT_LATCHED: "a fault is latched; clear it first",
    Refusal.NOT_HOMED: "positions are unknown before homing",
    Refusal.QUEUE_FULL: "the queue of the board is full",
    Refusal.WRONG_NUMBER: "a segment before it is missing",
    Refusal.BAD_TICKS: "a segment is too long",
    Refusal.DISCONTINUOUS: "a segment does not begin where the queue ends",
    Refusal.RATE_JUMP: "a segment begins at another speed than the queue ends",
    Refusal.TOO_FAST: "a segment is too fast",
    Refusal.BEYOND_TRAVEL: "a segment leads beyond the travel",
    Refusal.BAD_VALUE: "a number is outside its range",
    Refusal.CAUSE_PRESENT: "its cause is still there: the emergency-stop circuit is open",
    Refusal.CONFIG_CRC: "the configuration arrived incomplete",
    Refusal.NOT_AT_REST: "the drives are on; the configuration needs them off",
}


def refusal_words(refusal: int) -> str:
    """Why the board refused something; an unknown number is named."""
    try:
        return _REFUSALS[Refusal(refusal)]
    except ValueError:
        return f"the board gives a reason unknown to this version ({refusal})"


def refusal_reason(refusal: int) -> str:
    """Stable name of a refusal, as BoardRefusedError has it."""
    if refusal == Refusal.NONE or refusal not in set(Refusal):
        return "unknown"
    return Refusal(refusal).name.lower()


def fault_of(fault: int, detail: int, flags: TelemetryFlag) -> BoardFault | None:
    """A latched fault in words.

    Args:
        fault: A ``Fault``.
        detail: Bits of the axes concerned.
        flags: Of the same sample.

    Raises:
        ValueError: there is no such fault.
    """
    if fault == Fault.NONE:
        return None
    code = FAULTS[Fault(fault)]
    axes = [joint for bit, joint in enumerate(JOINTS) if detail & 1 << bit]
    where = " and ".join(axes)
    switch = f"The limit switch of {where}" if axes else "A limit switch"
    pressed = TelemetryFlag.ESTOP_OPEN in flags
    words = {
        FaultCode.EMERGENCY_STOP: "The emergency-stop circuit is open."
        if pressed
        else "Emergency stop.",
        FaultCode.LIMIT_SWITCH: f"{switch} opened.",
        FaultCode.FOLLOWING_ERROR: "The slide is too far from where it should be, or stays there.",
        FaultCode.STALL: "The slide pushes at its force limit and does not move.",
        FaultCode.QUEUE_UNDERRUN: "The queue ran empty while the robot was moving.",
        FaultCode.HEARTBEAT_LOST: "The host has fallen silent.",
        FaultCode.SEGMENT_MISMATCH: "The board is not where its segments should have led.",
        FaultCode.HOMING_FAILED: f"{switch} was not found, or does not open; look for a cut wire.",
        FaultCode.WATCHDOG: "The firmware hung and was restarted by its watchdog.",
    }
    return BoardFault(code, words[code])
