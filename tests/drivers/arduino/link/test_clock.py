from __future__ import annotations

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.arduino.link.clock import TICK_RANGE, BoardClock

TICK_HZ = 20_000


def run(
    clock: BoardClock,
    *,
    ppm: float,
    start_tick: int,
    seconds: float,
    rng: random.Random,
    held_up: float = 0.1,
) -> tuple[float, int]:
    """Ask a board once a second; some answers are held up. Returns the end: host time, tick."""
    rate = TICK_HZ * (1 + ppm * 1e-6)
    now_s = 1000.0
    while now_s < 1000.0 + seconds:
        there_s = rng.uniform(3e-4, 6e-4) + (0.03 * rng.random() if rng.random() < held_up else 0)
        back_s = rng.uniform(3e-4, 6e-4) + (0.03 * rng.random() if rng.random() < held_up else 0)
        tick = (start_tick + int((now_s + there_s - 1000.0) * rate)) % TICK_RANGE
        clock.add_answer(now_s, now_s + there_s + back_s, tick)
        now_s += 1.0
    return now_s, (start_tick + int((now_s - 1000.0) * rate)) % TICK_RANGE


@given(
    seed=st.integers(0, 2**32),
    ppm=st.floats(-5000, 5000),
    start_tick=st.integers(0, TICK_RANGE - 1),
)
def test_the_clock_is_right_to_a_millisecond(seed: int, ppm: float, start_tick: int) -> None:
    clock = BoardClock(TICK_HZ)
    host_s, tick = run(clock, ppm=ppm, start_tick=start_tick, seconds=40, rng=random.Random(seed))
    assert clock.host_time_s(tick) == pytest.approx(host_s, abs=1e-3)
    assert clock.tick_s * TICK_HZ == pytest.approx(1 / (1 + ppm * 1e-6), abs=1e-4)


def test_the_first_answer_is_enough_for_a_start() -> None:
    clock = BoardClock(TICK_HZ)
    clock.add_answer(50.0, 50.002, 4_000_000_000)
    assert clock.known
    assert clock.host_time_s(4_000_000_000) == pytest.approx(50.001)
    assert clock.host_time_s(4_000_020_000) == pytest.approx(51.001)


def test_the_counter_may_wrap_between_two_answers() -> None:
    clock = BoardClock(TICK_HZ)
    clock.add_answer(50.0, 50.001, TICK_RANGE - 10_000)
    clock.add_answer(51.0, 51.001, 10_000)
    assert clock.host_time_s(TICK_RANGE - 10_000) == pytest.approx(50.0005, abs=1e-3)
    assert clock.host_time_s(20_000) == pytest.approx(51.5005, abs=1e-3)


def test_an_answer_that_was_held_up_hardly_counts() -> None:
    clock = BoardClock(TICK_HZ)
    for second in range(5):
        clock.add_answer(second, second + 0.001, second * TICK_HZ + 10)
    clock.add_answer(5.0, 5.1, 5 * TICK_HZ + 10)
    assert clock.host_time_s(6 * TICK_HZ) == pytest.approx(6.0, abs=1e-3)


def test_without_an_answer_there_is_no_time() -> None:
    clock = BoardClock(TICK_HZ)
    assert not clock.known
    with pytest.raises(ValueError, match="not known"):
        clock.host_time_s(5)
