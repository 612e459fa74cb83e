"""How many damaged frames a board would take for commands; runs for a minute."""

from __future__ import annotations

import random
import sys
from time import perf_counter

from tests.support.link_corruption import corruption_campaign

FRAMES = 1_000_000


def main() -> None:
    start_s = perf_counter()
    result = corruption_campaign(FRAMES, random.Random(1))
    seconds = perf_counter() - start_s
    sys.stdout.write(
        f"{result.damaged_frames} damaged frames in {seconds:.0f} s\n"
        f"  with a right CRC all the same: {result.passed_crc}"
        f" (2^-16 of all blocks: {result.damaged_frames / 65536:.0f})\n"
        f"  passed all checks of a frame: {result.passed_frame}\n"
        f"  would have been obeyed: {result.believed} (wanted: 0)\n"
        f"  made the next frame unheard: {result.deaf_after} (wanted: 0)\n"
    )


if __name__ == "__main__":
    main()
