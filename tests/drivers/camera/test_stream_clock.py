"""How old the pictures of a stream are."""

from __future__ import annotations

import pytest

from drivers.camera.stream_clock import CLOCK_SET_S, REMEMBERED, StreamClock


def test_prompt_pictures_have_the_assumed_age() -> None:
    clock = StreamClock(0.2)
    taken = [clock.captured_s(100.0 + number / 25, number / 25) for number in range(50)]
    assert taken == pytest.approx([99.8 + number / 25 for number in range(50)])


def test_a_picture_that_was_held_up_is_older() -> None:
    clock = StreamClock(0.2)
    clock.captured_s(100.0, 7.0)
    assert clock.captured_s(101.0, 7.5) == pytest.approx(100.3)
    assert clock.captured_s(101.0, 8.0) == pytest.approx(100.8)


def test_a_camera_whose_clock_was_set_is_believed_again() -> None:
    clock = StreamClock(0.0)
    clock.captured_s(100.0, 50.0)
    assert clock.captured_s(100.1, 50.1 - 2 * CLOCK_SET_S) == pytest.approx(100.1)
    assert clock.captured_s(100.2, 50.2 + 2 * CLOCK_SET_S) == pytest.approx(100.2)


def test_a_camera_whose_clock_is_slow_does_not_grow_old() -> None:
    clock = StreamClock(0.0)
    period_s, slow = 0.04, 1 - 1e-4
    for number in range(10 * REMEMBERED):
        arrived_s = number * period_s
        age_s = arrived_s - clock.captured_s(arrived_s, arrived_s * slow)
    assert age_s < 1.1e-4 * REMEMBERED * period_s


def test_a_new_stream_begins_anew() -> None:
    clock = StreamClock(0.0)
    clock.captured_s(100.0, 3.0)
    clock.restart()
    assert clock.captured_s(101.0, 0.0) == pytest.approx(101.0)
