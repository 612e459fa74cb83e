"""What `plugpilot firmware monitor` says, against a board that speaks the real protocol."""

from __future__ import annotations

from collections.abc import Iterator

from drivers.arduino.link.frames import FrameReader
from drivers.arduino.listener import BoardListener
from drivers.arduino.protocol.messages import FROM_BOARD, TICK_HZ
from tests.support.fake_board import FakeBoard


def listen(board: FakeBoard, heard: list[bytes], listener: BoardListener) -> Iterator[str]:
    reader = FrameReader(FROM_BOARD)
    for tick in range(0, 3 * TICK_HZ, TICK_HZ // 100):
        if tick == TICK_HZ:
            board.press_stop_button()
        board.advance(tick)
        while heard:
            for frame in reader.feed(heard.pop(0)):
                yield from listener.hear(frame.message)
        board.hear(listener.take_answer())


def test_the_board_is_named_and_every_change_told() -> None:
    heard: list[bytes] = []
    board = FakeBoard(heard.append)
    lines = list(listen(board, heard, BoardListener()))
    assert lines[0].startswith("Hello(")
    samples = [line for line in lines if not line.startswith("Hello(")]
    assert samples[0].startswith("BOOT  rho1=0 rho2=0 rho3=0  12.0 V  25.1 degC  nothing pressed")
    assert any("FAULT  EMERGENCY_STOP" in line and "emergency stop" in line for line in samples)
    assert len(samples) < 10, "what has not changed is not repeated all the time"
    assert not board.heard, "no command was sent"
