"""What is told about the line to a board, and that listening changes nothing on it."""

from __future__ import annotations

import asyncio

import pytest

from drivers.arduino.link.frames import Frame, FrameReader, encode_frame
from drivers.arduino.protocol import messages
from drivers.arduino.protocol.messages import FROM_HOST, EventKind, Refusal, StopCategory
from drivers.arduino.tap import TappedLine, passage_of
from drivers.robot.traffic import Passage, Traffic


class Wire:
    """Keeps what is written."""

    def __init__(self) -> None:
        self.written = b""
        self.damaged = 0
        self.closed = False

    def write(self, data: bytes) -> None:
        self.written += data

    async def close(self) -> None:
        self.closed = True


STOP = Frame(0, 0, messages.Stop(category=StopCategory.DECELERATE_AND_HOLD, token=7))
BEAT = Frame(0, 0, messages.Heartbeat())
REFUSED = Frame(
    2, 5, messages.Event(kind=EventKind.REFUSED, code=Refusal.QUEUE_FULL, seq=4, detail=0, tick=9)
)


def test_both_ways_are_told_and_passed_on_unchanged() -> None:
    async def scenario() -> None:
        traffic, wire = Traffic(), Wire()
        told: list[Passage] = []
        heard: list[Frame] = []
        line = TappedLine(traffic, lambda frames, _: heard.extend(frames))
        line.lay_on(wire)
        traffic.listen(told.append)
        data = b"\0" + encode_frame(STOP) + encode_frame(BEAT)
        line.write(data)
        line.hear([REFUSED], 1.5)
        assert wire.written == data
        assert list(FrameReader(FROM_HOST).feed(wire.written)) == [STOP, BEAT]
        assert heard == [REFUSED]
        assert [(each.to_board, each.kind, each.error) for each in told] == [
            (True, "Stop", False),
            (True, "Heartbeat", False),
            (False, "Event", True),
        ]
        assert told[0].words == "seq=0 ack=0 category=DECELERATE_AND_HOLD token=7"
        assert "kind=REFUSED" in told[2].words
        assert told[0].size_bytes == len(encode_frame(STOP))
        await line.close()
        assert wire.closed

    asyncio.run(scenario())


def test_nothing_is_put_into_words_for_nobody(monkeypatch: pytest.MonkeyPatch) -> None:
    async def scenario() -> None:
        traffic, wire = Traffic(), Wire()
        line = TappedLine(traffic, lambda _frames, _at: None)
        line.lay_on(wire)
        told: list[Passage] = []
        traffic.listen(told.append)
        traffic.forget(told.append)
        monkeypatch.setattr("drivers.arduino.tap.passage_of", None)  # would fail when called
        line.write(encode_frame(BEAT))
        line.hear([REFUSED], 1.0)
        assert told == []

    asyncio.run(scenario())


def test_damage_on_the_line_is_an_error_told_once() -> None:
    traffic, wire = Traffic(), Wire()
    told: list[Passage] = []
    line = TappedLine(traffic, lambda _frames, _at: None)
    line.lay_on(wire)
    traffic.listen(told.append)
    wire.damaged = 3
    line.hear([], 1.0)
    line.hear([], 2.0)
    ((kind, words, error),) = [(each.kind, each.words, each.error) for each in told]
    assert (kind, error) == ("Damaged", True)
    assert words.startswith("3 ")


def test_numbers_of_a_newer_board_are_shown_as_numbers() -> None:
    event = messages.Event(kind=99, code=1, seq=0, detail=0, tick=0)
    assert "kind=99" in passage_of(Frame(0, 0, event), 0.0, to_board=False).words
