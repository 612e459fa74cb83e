"""The firmware's core, compiled for this computer."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drivers.arduino.steps import phase, position_after, rate_after, whole

FIRMWARE = Path(__file__).parents[3] / "drivers" / "arduino" / "firmware"
MAX_RATE = 2**31 - 1

pytestmark = pytest.mark.skipif(
    shutil.which("g++") is None or shutil.which("make") is None,
    reason="needs the Debian packages g++ and make",
)


def make(target: str, build: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        ["make", "-C", str(FIRMWARE), target, f"BUILD={build}"],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "MAKEFLAGS": ""},
    )


@pytest.fixture(scope="module")
def build(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("firmware")


@pytest.fixture(scope="module")
def replay(build: Path) -> Path:
    result = make("replay", build)
    assert result.returncode == 0, result.stdout + result.stderr
    return build / "host" / "replay"


def test_the_core_passes_its_tests(build: Path) -> None:
    result = make("host-tests", build)
    assert result.returncode == 0, result.stdout + result.stderr
    assert " tests, 0 failed checks" in result.stdout


@st.composite
def segments(draw: st.DrawFn) -> tuple[int, list[int], list[int]]:
    """Ticks, rates and accelerations of a segment that the board could be given."""
    ticks = draw(st.integers(1, 2000))
    rates, accelerations = [], []
    for _ in range(3):
        first, last = draw(st.integers(-MAX_RATE, MAX_RATE)), draw(st.integers(-MAX_RATE, MAX_RATE))
        rates.append(first)
        accelerations.append(int((last - first) / ticks))
    return ticks, rates, accelerations


@settings(max_examples=40, deadline=None)
@given(
    start=st.lists(st.integers(-(2**47), 2**47), min_size=3, max_size=3),
    chain=st.lists(segments(), min_size=1, max_size=60),
)
def test_the_firmware_is_where_the_host_expects_it(
    replay: Path, start: list[int], chain: list[tuple[int, list[int], list[int]]]
) -> None:
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
    result = subprocess.run(
        [str(replay)], input="\n".join(lines) + "\n", capture_output=True, text=True, check=True
    )
    assert result.stdout.splitlines() == expected
