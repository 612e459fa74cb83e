"""The firmware's core against what the host expects of it."""

from __future__ import annotations

import random
from collections.abc import Callable

from hypothesis import given, settings
from hypothesis import strategies as st

from drivers.arduino.steps import phase, position_after, rate_after, whole
from tests.drivers.arduino_firmware.conftest import Firmware

MAX_RATE = 2**31 - 1
SEGMENTS = 100_000

Part = tuple[int, list[int], list[int]]
"""Ticks, rates and accelerations of a segment."""

Run = Callable[[str, list[str]], list[str]]


def test_the_core_passes_its_tests(firmware: Firmware) -> None:
    assert " tests, 0 failed checks" in firmware.make("host-tests")


def expect_the_firmware_there(run: Run, start: list[int], chain: list[Part]) -> None:
    """The steps at the pins lead to where the host's integers lead, segment by segment."""
    lines = [" ".join(f"{whole(p)} {phase(p)}" for p in start)]
    expected = []
    position = list(start)
    for ticks, rates, accelerations in chain:
        lines.append(" ".join(map(str, [ticks, *rates, *accelerations])))
        position = [
            position_after(p, rate, acceleration, ticks)
            for p, rate, acceleration in zip(position, rates, accelerations, strict=True)
        ]
        ends = [rate_after(r, a, ticks) for r, a in zip(rates, accelerations, strict=True)]
        assert max(map(abs, ends)) <= MAX_RATE
        expected.append(" ".join(f"{whole(p)} {phase(p)}" for p in position))
    assert run("replay", lines) == expected


@st.composite
def parts(draw: st.DrawFn) -> Part:
    """A segment that the board could be given, with a liking for the extremes."""
    ticks = draw(st.integers(1, 2000))
    rates, accelerations = [], []
    for _ in range(3):
        first, last = draw(st.integers(-MAX_RATE, MAX_RATE)), draw(st.integers(-MAX_RATE, MAX_RATE))
        change = int((last - first) / ticks)
        rates.append(first)
        accelerations.append(change if abs(change) <= MAX_RATE else 0)  # 32 bits on the wire
    return ticks, rates, accelerations


@settings(max_examples=30, deadline=None)
@given(
    start=st.lists(st.integers(-(2**47), 2**47), min_size=3, max_size=3),
    chain=st.lists(parts(), min_size=1, max_size=60),
)
def test_the_firmware_is_where_the_host_expects_it(
    run: Run, start: list[int], chain: list[Part]
) -> None:
    expect_the_firmware_there(run, start, chain)


def test_after_a_hundred_thousand_segments_the_firmware_is_where_the_host_expects_it(
    run: Run,
) -> None:
    rng = random.Random(31)
    chain = [_random_part(rng) for _ in range(SEGMENTS)]
    expect_the_firmware_there(run, [0, -(2**40), 2**40 + 1], chain)


def _random_part(rng: random.Random) -> Part:
    ticks = rng.randint(2, 800)
    rates, accelerations = [], []
    for _ in range(3):
        first, last = rng.randint(-MAX_RATE, MAX_RATE), rng.randint(-MAX_RATE, MAX_RATE)
        rates.append(first)
        accelerations.append(int((last - first) / ticks))
    return ticks, rates, accelerations
