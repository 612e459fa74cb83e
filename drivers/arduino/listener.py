"""Listens to a board without driving it, for a person who checks the wiring."""

from __future__ import annotations

import secrets
from collections.abc import Iterator

from drivers.arduino.link.frames import Frame, encode_frame
from drivers.arduino.protocol import messages
from drivers.arduino.protocol.message import Message
from drivers.arduino.protocol.messages import PROTOCOL_HASH, Fault, State, TelemetryFlag
from drivers.arduino.telemetry import temperature_degc

REPEAT_SAMPLES = 50
"""Without a change every so many samples are told: five seconds at rest."""

_SIGNS = {
    TelemetryFlag.ENABLED: "drives on",
    TelemetryFlag.HOMED: "homed",
    TelemetryFlag.SWITCH_RHO1: "switch rho1",
    TelemetryFlag.SWITCH_RHO2: "switch rho2",
    TelemetryFlag.SWITCH_RHO3: "switch rho3",
    TelemetryFlag.ESTOP_OPEN: "emergency stop",
    TelemetryFlag.LATE_TICK: "late tick",
    TelemetryFlag.RX_OVERRUN: "bytes lost",
    TelemetryFlag.KEPT_DAMAGED: "kept configuration damaged",
}


class BoardListener:
    """Begins a session, so that the board tells what it sees, and puts that into words."""

    def __init__(self) -> None:
        self._session = secrets.randbelow(0xFFFF) + 1
        self._answer = b""
        self._told: tuple[object, ...] = ()
        self._untold = 0

    def hear(self, message: Message) -> Iterator[str]:
        """Take a message of the board and say what is new in it."""
        match message:
            case messages.Hello():
                yield str(message)
                if message.session == 0:
                    # only now, so that no boot loader hears it
                    request = messages.HelloRequest(PROTOCOL_HASH, self._session)
                    self._answer = b"\0" + encode_frame(Frame(0, 0, request))
            case messages.Telemetry():
                shown = (message.state, message.fault, message.flags, message.measured_rho3)
                self._untold += 1
                if shown != self._told or self._untold >= REPEAT_SAMPLES:
                    self._told, self._untold = shown, 0
                    yield sample_words(message)

    def take_answer(self) -> bytes:
        """What must be sent to the board now, if anything."""
        answer, self._answer = self._answer, b""
        return answer


def sample_words(sample: messages.Telemetry) -> str:
    """One sample in a line; positions in microsteps and counts."""
    flags = TelemetryFlag(sample.flags)
    signs = [words for flag, words in _SIGNS.items() if flag in flags]
    one, two, _ = sample.commanded
    warmth_degc = temperature_degc(sample)
    parts = [
        State(sample.state).name if sample.state in set(State) else f"state {sample.state}",
        *([Fault(sample.fault).name] if sample.fault in set(Fault) and sample.fault else []),
        f"rho1={one} rho2={two} rho3={sample.measured_rho3}",
        f"{sample.supply_mv / 1000:.1f} V",
        "temperature unknown" if warmth_degc is None else f"{warmth_degc:.1f} degC",
        ", ".join(signs) or "nothing pressed",
    ]
    return "  ".join(parts)
