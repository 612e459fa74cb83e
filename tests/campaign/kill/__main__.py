"""Runs the kill campaign and prints its table: ``python -m tests.campaign.kill``."""

from __future__ import annotations

import argparse
import contextlib
import math
import sys
import time
from collections import Counter
from itertools import count
from statistics import median

from tests.campaign.kill.story import Kill, Story, tell

KILLS_IN_A_STORY = 6


def main() -> int:
    """Returns the exit code: 0 when nothing was broken."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0, help="of the first garage")
    parser.add_argument("--speed", type=float, default=10.0, help="simulated seconds per second")
    options = parser.parse_args()
    stories: list[Story] = []
    began_s = time.monotonic()
    with contextlib.suppress(KeyboardInterrupt):  # the table of what there is
        for seed in count(options.seed):
            left = options.kills - sum(len(story.kills) for story in stories)
            if left <= 0:
                break
            stories.append(tell(seed, min(KILLS_IN_A_STORY, left), options.speed))
            print(_line(stories[-1]), flush=True)
    print(f"\n{report(stories)}\n{time.monotonic() - began_s:.0f} s")
    return 1 if any(story.broken for story in stories) else 0


def report(stories: list[Story]) -> str:
    """The table."""
    kills = [kill for story in stories for kill in story.kills]
    lines = [f"{'killed in':14s} kills  dark  decided after, median / p95 [s]"]
    for phase, times in sorted(Counter(kill.phase for kill in kills).items()):
        here = [kill for kill in kills if kill.phase == phase]
        dark = sum(kill.dark for kill in here)
        lines.append(f"{phase or 'not accepted':14s} {times:5d} {dark:5d}  {_times(here)}")
    lines.append(f"{'all':14s} {len(kills):5d} {sum(k.dark for k in kills):5d}  {_times(kills)}")
    lines.append("")
    lines += [
        f"{times:5d}  {kind}: {outcome}"
        for (kind, outcome), times in sorted(
            Counter((story.kind, story.outcome) for story in stories).items()
        )
    ]
    asked = Counter(code for story in stories for code in story.asked)
    lines.append(f"asked a person: {dict(asked) or 'never'}")
    broken = [f"seed {story.seed}: {what}" for story in stories for what in story.broken]
    lines.append("broken: " + ("; ".join(broken) or "nothing"))
    return "\n".join(lines)


def _line(story: Story) -> str:
    phases = ", ".join(_name(kill) for kill in story.kills)
    line = f"{story.seed:4d} {story.kind:8s} killed in {phases or 'no phase'}: {story.outcome}"
    if story.asked:
        line += f" asked: {', '.join(story.asked)}"
    if story.broken:
        line += f" BROKEN: {'; '.join(story.broken)}"
    return line


def _times(kills: list[Kill]) -> str:
    times_s = sorted(kill.decided_s for kill in kills if not math.isnan(kill.decided_s))
    if not times_s:
        return "-"
    p95_s = times_s[min(len(times_s) - 1, math.ceil(0.95 * len(times_s)) - 1)]
    return f"{median(times_s):.1f} / {p95_s:.1f}"


def _name(kill: Kill) -> str:
    return f"{kill.phase}{' (dark)' if kill.dark else ''}"


if __name__ == "__main__":
    sys.exit(main())
