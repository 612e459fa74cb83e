"""Faults of the motion board in words a person can act on."""

from __future__ import annotations

from dataclasses import dataclass

from drivers.robot import BoardFault, FaultCode


@dataclass(frozen=True, slots=True)
class FaultWords:
    """Title and remedy of a fault."""

    title: str
    remedy: str


_WORDS = {
    FaultCode.EMERGENCY_STOP: FaultWords(
        "The emergency stop is active",
        "Make sure that everyone is safe, then release the emergency stop and home the robot.",
    ),
    FaultCode.LIMIT_SWITCH: FaultWords(
        "The robot ran into the end of its travel",
        "Look whether a switch or its wire is damaged, then release the fault and home the robot.",
    ),
    FaultCode.FOLLOWING_ERROR: FaultWords(
        "The robot could not follow its path",
        "Look for something that blocks or brakes it, then release the fault and home the robot.",
    ),
    FaultCode.STALL: FaultWords(
        "The plug is blocked",
        "Look for something in front of the plug or in the socket, then release the fault.",
    ),
    FaultCode.QUEUE_UNDERRUN: FaultWords(
        "The motion was not sent in time",
        "Release the fault and try again. If it comes back, the computer is overloaded.",
    ),
    FaultCode.HEARTBEAT_LOST: FaultWords(
        "The motion board lost touch with PlugPilot",
        "Check the USB cable, then release the fault.",
    ),
    FaultCode.SEGMENT_MISMATCH: FaultWords(
        "The motion board and PlugPilot disagree about the position",
        "Release the fault and home the robot.",
    ),
    FaultCode.HOMING_FAILED: FaultWords(
        "The robot could not find its zero",
        "Look for something in its way and at the limit switches, then release the fault.",
    ),
    FaultCode.WATCHDOG: FaultWords(
        "The motion board restarted itself",
        "Release the fault and home the robot. If it comes back, call a technician.",
    ),
}


def words_for(fault: BoardFault) -> FaultWords:
    """Title and remedy of a latched fault."""
    return _WORDS[fault.code]
