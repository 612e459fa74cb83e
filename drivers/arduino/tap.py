"""Listens to the line between host and board, both ways, without changing anything on it."""

from __future__ import annotations

import asyncio
from dataclasses import fields
from enum import IntEnum, IntFlag
from typing import Protocol, runtime_checkable

from drivers.arduino.link.frames import Frame, FrameReader, encode_frame
from drivers.arduino.protocol import messages
from drivers.arduino.protocol.messages import (
    FROM_HOST,
    BoardKind,
    EventKind,
    Fault,
    Refusal,
    ResetCause,
    State,
    StopCategory,
    TelemetryFlag,
)
from drivers.arduino.serial_port import Line, OnFrames
from drivers.robot.traffic import Passage, Traffic

_NAMES: dict[tuple[type[object] | None, str], type[IntEnum | IntFlag]] = {
    (None, "state"): State,
    (None, "fault"): Fault,
    (None, "refusal"): Refusal,
    (None, "reset_cause"): ResetCause,
    (None, "board"): BoardKind,
    (messages.Telemetry, "flags"): TelemetryFlag,
    (messages.Event, "kind"): EventKind,
    (messages.Stop, "category"): StopCategory,
}
"""Fields whose numbers have names, in any message or in one."""


@runtime_checkable
class CountsDamage(Protocol):
    """A line that counts what arrived damaged."""

    @property
    def damaged(self) -> int:
        """Frames that arrived damaged since the line was opened."""
        ...


class TappedLine:
    """A Line that tells what is written to it; given what is heard, it tells that, too.

    Args:
        traffic: Who is told.
        on_frames: Gets what was heard afterwards.
    """

    def __init__(self, traffic: Traffic, on_frames: OnFrames) -> None:
        self._traffic = traffic
        self._on_frames = on_frames
        self._line: Line | None = None
        self._damaged = 0

    def lay_on(self, line: Line) -> None:
        """The line is open now."""
        self._line = line

    def write(self, data: bytes) -> None:
        """Send bytes; returns at once."""
        if self._line is None:
            raise RuntimeError("nothing can be sent before the line is open")
        self._line.write(data)
        if self._traffic.heard:
            now_s = asyncio.get_running_loop().time()
            for frame in FrameReader(FROM_HOST).feed(data):
                self._traffic.tell(passage_of(frame, now_s, to_board=True))

    @property
    def damaged(self) -> int | None:
        """Frames that arrived damaged since the line was opened; None if the line counts none."""
        return self._line.damaged if isinstance(self._line, CountsDamage) else None

    async def close(self) -> None:
        """Send what is queued and close the line. Safe to call twice."""
        if self._line is not None:
            await self._line.close()

    def hear(self, frames: list[Frame], received_s: float) -> None:
        """Frames of the board have arrived."""
        self._count_damage(received_s)
        if self._traffic.heard:
            for frame in frames:
                self._traffic.tell(passage_of(frame, received_s, to_board=False))
        self._on_frames(frames, received_s)

    def _count_damage(self, received_s: float) -> None:
        more = (self.damaged or 0) - self._damaged
        self._damaged += more
        if more and self._traffic.heard:
            words = f"{more} with a wrong check sum or length"
            self._traffic.tell(Passage(received_s, False, "Damaged", words, error=True))


def passage_of(frame: Frame, at_s: float, *, to_board: bool) -> Passage:
    """A frame in words."""
    return Passage(
        at_s=at_s,
        to_board=to_board,
        kind=type(frame.message).__name__,
        words=_words(frame),
        size_bytes=len(encode_frame(frame)),
        error=_is_error(frame),
    )


def _words(frame: Frame) -> str:
    message = frame.message
    parts = [f"seq={frame.seq}", f"ack={frame.ack}"]
    for field in fields(message):
        value = getattr(message, field.name)
        parts.append(f"{field.name}={_value(type(message), field.name, value)}")
    return " ".join(parts)


def _value(kind: type[object], name: str, value: object) -> str:
    names = _NAMES.get((kind, name)) or _NAMES.get((None, name))
    if names is not None and isinstance(value, int):
        try:
            return names(value).name or str(value)
        except ValueError:
            return str(value)  # a newer board knows more names
    if isinstance(value, tuple):
        return ",".join(map(str, value))
    return str(value)


def _is_error(frame: Frame) -> bool:
    match frame.message:
        case messages.Event(kind=kind):
            return kind in {EventKind.REFUSED, EventKind.FAULT_LATCHED}
        case messages.Telemetry(flags=flags):
            return bool(flags & TelemetryFlag.RX_OVERRUN)
        case messages.EmergencyStop():
            return True
    return False
