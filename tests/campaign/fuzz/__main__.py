"""Fuzzes everything that takes something from outside: ``python -m tests.campaign.fuzz``.

Each target gets its turn of some seconds, again and again, until the time is over. It ends with
status 1 when something broke: a crash, an answer of 5xx, a stop that did not come through, an
error in the log, or memory that grew.
"""

from __future__ import annotations

import argparse
import contextlib
import logging
import os
import random
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

from tests.campaign.fuzz.http_requests import RawHttp, Rest
from tests.campaign.fuzz.labels import Labels
from tests.campaign.fuzz.memory import FRUGAL_ALLOCATOR, MemoryWatch
from tests.campaign.fuzz.serial_line import SerialLine
from tests.campaign.fuzz.sockets import LiveSocket, TwinSocket
from tests.campaign.fuzz.target import BrokenError, Target
from tests.campaign.fuzz.tidying import tidy
from tests.support.process import ServerProcess, serving

TURN_S = 5.0
FAILED = ("Traceback (most recent call last)", " ERROR ", " CRITICAL ")
WEBHOOKS = '[webhooks]\nallowed_networks = ["127.0.0.0/8"]\n'


def main() -> int:
    """Returns the exit code."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--log", type=Path, help="keep what the server logs in this file")
    options = parser.parse_args()
    logging.disable(logging.CRITICAL)  # of this process: the driver complains of the board's lies
    os.environ.update(FRUGAL_ALLOCATOR)
    with tempfile.TemporaryDirectory() as scratch:
        config, log = Path(scratch) / "plugpilot.toml", options.log or Path(scratch) / "log"
        config.write_text(WEBHOOKS)
        with _errors_into(log), serving(f"--config={config}", "--speed=10") as server:
            broken = _fuzz(server, 60 * options.minutes, random.Random(options.seed))
            said = log.read_text().splitlines()
            broken += [line for line in said if any(failed in line for failed in FAILED)]
            if server.stop() != 0:
                broken.append("the server did not end in order")
    for what in broken[:20]:
        print(f"BROKEN: {what[:2000]}")
    return 1 if broken else 0


def _fuzz(server: ServerProcess, duration_s: float, rng: random.Random) -> list[str]:
    targets: Sequence[Target] = (
        Rest(server, rng),
        RawHttp(server, rng),
        LiveSocket(server, rng),
        TwinSocket(server, rng),
        SerialLine(rng),
        Labels(rng),
    )
    watch, broken = MemoryWatch(server.process.pid), list[str]()
    began_s = time.monotonic()
    while time.monotonic() < began_s + duration_s and not broken:
        for target in targets:
            try:
                target.run(time.monotonic() + TURN_S)
            except BrokenError as error:
                broken.append(f"{target.name}: {error}")
            if server.process.poll() is not None:
                broken.append(f"the server has ended after {target.name}")
                break
        else:
            tidy(server)
            watch.look()
            tried = sum(target.tried for target in targets)
            print(f"\r{tried} inputs, {watch.seen_mib[-1]:.0f} MiB  ", end="", flush=True)
    print(f"\r{(time.monotonic() - began_s) / 60:.1f} minutes")
    for target in targets:
        print(f"  {target.name:<28}{target.tried:>10} inputs")
    if watch.seen_mib:
        print(f"  memory of the server: {watch}")
        if watch.grows:
            broken.append("the server's memory grows")
    return broken


@contextlib.contextmanager
def _errors_into(log: Path) -> Iterator[None]:
    """What this process and the server say on standard error goes into a file."""
    kept = os.dup(2)
    with log.open("wb") as file:
        os.dup2(file.fileno(), 2)
    try:
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)


if __name__ == "__main__":
    sys.exit(main())
