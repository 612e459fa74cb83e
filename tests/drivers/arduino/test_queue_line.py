from __future__ import annotations

from dataclasses import replace

from drivers.arduino.protocol import messages
from drivers.arduino.queue_line import QueueLine
from drivers.arduino.steps import Triple, point_after, segment_end, whole

RESTING = messages.Telemetry.unpack(bytes(messages.Telemetry.LAYOUT.size))
RATE = 1 << 29  # a step every 4 ticks
NUMBER = 65_535


def segment(number: int, start: Triple, rate: int, acceleration: int = 0) -> messages.Segment:
    wholes = (whole(start[0]), whole(start[1]), whole(start[2]))
    return messages.Segment(
        number, 400, wholes, (0, 0, 0), (rate, -rate, 0), (acceleration, -acceleration, 0)
    )


def running_line() -> tuple[QueueLine, messages.Segment, messages.Segment]:
    """Two segments; their numbers wrap between them."""
    line = QueueLine()
    line.begin((0, 0, 0), NUMBER)
    first = segment(NUMBER, (0, 0, 0), RATE)
    line.append(first)
    second = segment(0, segment_end(first).position, RATE)
    line.append(second)
    return line, first, second


def sample_of(running: messages.Segment, tick: int, off: int = 0) -> messages.Telemetry:
    point = point_after(running, tick)
    commanded = (whole(point.position[0]) + off, whole(point.position[1]), 0)
    return replace(
        RESTING, segment=running.number, segment_tick=tick, next_segment=1, commanded=commanded
    )


def test_every_tick_of_the_line_is_known() -> None:
    line, first, second = running_line()
    for running in (first, second):
        for tick in (0, 1, 3, 4, 200, 399, 400):
            assert line.expected(sample_of(running, tick)) == point_after(running, tick)
            assert not line.contradicts(sample_of(running, tick))


def test_a_single_step_is_a_contradiction() -> None:
    line, first, second = running_line()
    assert line.contradicts(sample_of(first, 200, off=1))
    assert line.contradicts(sample_of(second, 200, off=-1))


def test_the_end_is_where_the_last_segment_ends() -> None:
    line, _, second = running_line()
    end = segment_end(second)
    assert line.end == end
    resting = replace(sample_of(second, 400), segment=1, segment_tick=0)
    point = line.expected(resting)
    assert point is not None
    assert point.position == end.position
    assert point.rate == (0, 0, 0)
    assert line.contradicts(replace(resting, commanded=(0, 0, 0)))


def test_segments_in_the_board_are_counted_across_the_wrap() -> None:
    line, first, second = running_line()
    assert line.in_board(sample_of(first, 10)) == 2
    assert line.in_board(sample_of(second, 10)) == 1
    assert line.in_board(replace(sample_of(second, 400), segment=1)) == 0


def test_finished_segments_are_dropped() -> None:
    line, first, second = running_line()
    line.expected(sample_of(second, 10))
    assert list(line._segments) == [second]
    assert line.expected(sample_of(first, 10)) is None, "an old sample is no contradiction"


def test_nothing_is_known_of_a_line_that_was_left() -> None:
    line, first, _ = running_line()
    line.forget()
    assert line.end is None
    assert line.expected(sample_of(first, 10)) is None
    assert not line.contradicts(sample_of(first, 10, off=5))


def test_a_sample_from_before_the_line_does_not_touch_it() -> None:
    line, first, _ = running_line()
    assert line.untouched(replace(RESTING, next_segment=NUMBER))
    assert not line.untouched(sample_of(first, 0))
