"""When the force of the slide's motor is the force on the plug."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from twin.slide_pace import SAMPLES, SlidePace

PERIOD_S = 0.01
SPEED_MM_S = 14.0
COUNT_MM = 1 / 93

Course = Callable[[float], float]


def pace(
    slide_mm: Course, set_point_mm_s: Course = lambda _: SPEED_MM_S, *, way: int = 1
) -> SlidePace:
    """A slide at a place, beside a set point of a speed, both along the motion and over time."""
    found = SlidePace()
    for i in range(2 * SAMPLES):
        t = i * PERIOD_S
        speed_mm_s = set_point_mm_s(t)
        found.take(t, way * speed_mm_s * t, way * speed_mm_s, way * slide_mm(t))
    return found


@pytest.mark.parametrize("way", [1, -1], ids=["in", "out"])
@pytest.mark.parametrize(
    ("slide_mm", "too_much", "too_little"),
    [
        pytest.param(lambda t: SPEED_MM_S * t - 0.28, True, True, id="cruises"),
        pytest.param(lambda t: 16.0 * t - 0.3, True, True, id="makes up for lost way"),
        pytest.param(lambda t: 12.0 * t + 25.0 * t * t, False, False, id="speeds up"),
        pytest.param(lambda t: 14.0 * t - 25.0 * t * t, True, False, id="is slowed down"),
        pytest.param(lambda t: 0.0 * t, True, True, id="stands"),
    ],
)
def test_each_kind_of_motion(
    way: int, slide_mm: Course, *, too_much: bool, too_little: bool
) -> None:
    found = pace(slide_mm, way=way)
    assert (found.shows_too_much, found.shows_too_little) == (too_much, too_little)


def test_a_slide_that_keeps_up_with_a_set_point_that_speeds_up_speeds_up_itself() -> None:
    found = SlidePace()
    for i in range(2 * SAMPLES):
        t = i * PERIOD_S
        found.take(t, 2.0 * t + 50.0 * t * t, 2.0 + 100.0 * t, 2.0 * t + 50.0 * t * t)
    assert not found.shows_too_much
    assert not found.shows_too_little


@given(start_mm=st.floats(0, COUNT_MM), speed_mm_s=st.floats(5.0, 20.0), lag_mm=st.floats(0, 2.0))
def test_the_counts_of_the_encoder_are_no_acceleration(
    start_mm: float, speed_mm_s: float, lag_mm: float
) -> None:
    def counted_mm(t: float) -> float:
        return round((start_mm + speed_mm_s * t - lag_mm) / COUNT_MM) * COUNT_MM

    found = pace(counted_mm, lambda _: speed_mm_s)
    assert found.shows_too_much
    assert found.shows_too_little


def test_a_slide_that_has_only_just_stopped_swinging_shows_nothing_that_is_missing() -> None:
    def speed_mm_s(t: float) -> float:
        return SPEED_MM_S + max(3.0 - 30.0 * t, 0.0)

    found = SlidePace()
    measured_mm, shown_s = 0.0, []
    for i in range(40):
        t = i * PERIOD_S
        found.take(t, SPEED_MM_S * t, SPEED_MM_S, measured_mm)
        measured_mm += speed_mm_s(t) * PERIOD_S
        assert found.shows_too_much == (i >= SAMPLES - 1)
        if found.shows_too_little:
            shown_s.append(t)
    assert 0.2 < shown_s[0] < 0.3


def test_at_rest_and_before_there_are_samples_nothing_is_shown() -> None:
    forgotten = pace(lambda t: SPEED_MM_S * t)
    assert forgotten.shows_too_much
    forgotten.reset()
    for found in (forgotten, SlidePace(), pace(lambda _: 0.0, lambda _: 0.0)):
        assert not found.shows_too_much
        assert not found.shows_too_little
