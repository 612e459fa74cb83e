"""What a fake board refuses in which state."""

from __future__ import annotations

from drivers.arduino.protocol.messages import Refusal, State

NOT_READY = {
    State.BOOT: Refusal.NOT_CONFIGURED,
    State.IDLE: Refusal.DRIVES_OFF,
    State.HOMING: Refusal.HOMING,
    State.RUN: Refusal.MOVING,
    State.STOPPING: Refusal.STOPPING,
    State.FAULT: Refusal.FAULT_LATCHED,
}
