"""Dies at every entry of the journal: ``python -m tests.campaign.kill.entries``."""

from __future__ import annotations

import logging
import sys
import tempfile
from itertools import count, product
from pathlib import Path

from tests.support.killing.lives import ENDS, die_at_entry


def main() -> int:
    """Returns the exit code: 0 when every job was finished."""
    logging.disable(logging.CRITICAL)
    broken = 0
    for kind, when, dark in product(ENDS, ("before", "after"), (False, True)):
        died = 0
        for number in count(1):
            with tempfile.TemporaryDirectory(dir="/dev/shm") as folder:
                try:
                    if not die_at_entry(kind, when, number, Path(folder), dark=dark):
                        break
                except AssertionError as error:
                    broken += 1
                    print(f"{kind} {when} {number} {'dark' if dark else 'killed'}: {error}")
            died += 1
        print(f"{kind:8s} {when:6s} {'dark' if dark else 'killed':6s} {died:3d} deaths", flush=True)
    print(f"broken: {broken or 'nothing'}")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
