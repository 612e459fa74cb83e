"""Runs the hostile campaign and prints its figures: ``python -m tests.campaign.hostile``."""

from __future__ import annotations

import argparse
import logging
import math
import sys
import time
from statistics import median

from tests.campaign.hostile.rounds import Figures, attack_in_one_garage
from tests.campaign.hostile.witness import Danger

IN_ONE_GARAGE = 20
ROUNDING_S = 0.005
SIDEWAYS_MM = 0.05
BRAKING_S = 0.08
"""From being told to standing still: the way to the board, and 12 mm/s at 400 mm/s^2."""


def main() -> int:
    """Returns the exit code: 0 when nothing was broken."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--timings", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0, help="of the first garage")
    options = parser.parse_args()
    logging.disable(logging.CRITICAL)
    figures, began_s, seed = Figures(), time.perf_counter(), options.seed
    while figures.timings < options.timings:
        figures.add(
            attack_in_one_garage(seed, min(IN_ONE_GARAGE, options.timings - figures.timings))
        )
        seed += 1
        print(f"\r{figures.timings} timings, {len(figures.closings)} closings", end="", flush=True)
    print(f"\r{report(figures)}\n{time.perf_counter() - began_s:.0f} s of computing")
    return 1 if broken(figures) else 0


def broken(figures: Figures) -> list[str]:
    """What must never happen, and did."""
    dangers = [*figures.closings, *figures.enablings]
    late = [d for d in dangers if d.told_after_s > d.sample_s + ROUNDING_S]
    slow = [d for d in dangers if d.still_after_s > d.sample_s + BRAKING_S]
    return [
        *(f"told to stop only after {1e3 * d.told_after_s:.0f} ms" for d in late),
        *(f"stood still only after {1e3 * d.still_after_s:.0f} ms" for d in slow),
        *(["a motion began under load"] * figures.begun_under_load),
        *(["the plug moved sideways in the socket"] * (figures.lateral_mm > SIDEWAYS_MM)),
        *figures.lost,
    ]


def report(figures: Figures) -> str:
    """The figures as text."""
    lines = [
        f"{figures.timings} timings",
        f"motions of the plug begun in the socket        {figures.begun}",
        f"  of these under load                          {figures.begun_under_load}",
        *_dangers("station enabled while the plug moved", figures.enablings),
        *_dangers("contactor closed while the plug moved", figures.closings),
        f"pilot parted with the contactor closed         {figures.load_breaks}",
        f"largest sideways motion in the socket [mm]     {figures.lateral_mm:.3f}",
        f"ways back that were not found                  {len(figures.lost)}",
        "jobs ended with",
        *(f"  {count:5d}  {code}" for code, count in figures.outcomes.most_common()),
        *(f"BROKEN: {what}" for what in broken(figures)),
    ]
    return "\n".join(lines)


def _dangers(what: str, dangers: list[Danger]) -> list[str]:
    return [
        f"{what:<47}{len(dangers)}",
        f"  told to stop after [ms]{'':22}{_spread([d.told_after_s for d in dangers])}",
        f"  stood still after [ms]{'':23}{_spread([d.still_after_s for d in dangers])}",
        f"  share of one sample of the station{'':11}{_shares(dangers)}",
    ]


def _shares(dangers: list[Danger]) -> str:
    if not dangers:
        return "-"
    return f"worst {max(d.told_after_s / d.sample_s for d in dangers):.2f} of it to being told"


def _spread(times_s: list[float]) -> str:
    if not times_s:
        return "-"
    times_ms = sorted(1e3 * t for t in times_s)
    p95 = times_ms[math.ceil(0.95 * len(times_ms)) - 1]
    return f"median {median(times_ms):.0f}, p95 {p95:.0f}, worst {times_ms[-1]:.0f}"


if __name__ == "__main__":
    sys.exit(main())
