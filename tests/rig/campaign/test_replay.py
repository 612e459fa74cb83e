"""A hundred thousand random segments on the core of the firmware, compiled for this computer."""

from __future__ import annotations

import subprocess

from drivers.arduino.steps import phase, segment_end, whole
from tests.rig.build import FIRMWARE, missing_packages
from tests.rig.chains import RandomSegments
from tests.rig.machine import standing_machine

SEGMENTS = 100_000
START = (30_000 << 31, 30_000 << 31, 9_000 << 31)


def test_the_core_is_where_the_host_expects_it_after_each_of_many_segments() -> None:
    assert not missing_packages()
    subprocess.run(
        ["make", "--silent", f"--directory={FIRMWARE}", "replay"], check=True, capture_output=True
    )
    chance = RandomSegments(standing_machine(), seed=7)
    lines = [" ".join(f"{whole(p)} {phase(p)}" for p in START)]
    expected: list[str] = []
    at = START
    while len(expected) < SEGMENTS:
        for segment in chance.group(at, 0):
            lines.append(" ".join(map(str, [segment.ticks, *segment.rate, *segment.acceleration])))
            at = segment_end(segment).position
            expected.append(" ".join(f"{whole(p)} {phase(p)}" for p in at))
    replayed = subprocess.run(
        [FIRMWARE / "build" / "host" / "replay"],
        input="\n".join(lines) + "\n",
        capture_output=True,
        text=True,
        check=True,
    )
    assert replayed.stdout.splitlines() == expected
