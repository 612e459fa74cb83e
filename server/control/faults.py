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
        "Make sure that everyone is safe. If the button on the robot was pressed, turn it until it "
        "springs out. Then release the stop here.",
    ),
    FaultCode.LIMIT_SWITCH: FaultWords(
        "The robot ran into a limit switch",
        "See whether the robot stands at the end of its travel. If it does, release the fault; it "
        "finds its position anew. If not, the switch or its wire is broken: have it mended.",
    ),
    FaultCode.FOLLOWING_ERROR: FaultWords(
        "The robot could not follow its path",
        "Look for something that blocks, brakes or pushes the plug, then release the fault. If it "
        "comes back, have the motor and its encoder checked.",
    ),
    FaultCode.STALL: FaultWords(
        "The plug is blocked",
        "Look for something in front of the plug or in the socket, then release the fault.",
    ),
    FaultCode.QUEUE_UNDERRUN: FaultWords(
        "The motion was not sent in time",
        "Release the fault and try again. If it comes back, this computer is overloaded or the USB "
        "cable is bad.",
    ),
    FaultCode.HEARTBEAT_LOST: FaultWords(
        "The motion board lost touch with PlugPilot",
        "Check that the USB cable is firmly in at both ends, then release the fault. If it comes "
        "back, this computer is overloaded.",
    ),
    FaultCode.SEGMENT_MISMATCH: FaultWords(
        "The motion board and PlugPilot disagree about the position",
        "Release the fault; the robot finds its position anew. If it comes back, call a "
        "technician.",
    ),
    FaultCode.HOMING_FAILED: FaultWords(
        "The robot could not find its position",
        "Look for something in its way, and whether the limit switch that is named works and its "
        "wire is whole. Then release the fault and try again.",
    ),
    FaultCode.WATCHDOG: FaultWords(
        "The motion board restarted itself",
        "Release the fault; the robot finds its position anew. If it comes back, call a "
        "technician.",
    ),
}


def words_for(fault: BoardFault) -> FaultWords:
    """Title and remedy of a latched fault."""
    return _WORDS[fault.code]
