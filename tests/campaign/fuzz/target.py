"""What is fuzzed, and what counts as broken."""

from __future__ import annotations

import random
from typing import Protocol

MOST_CHANGES = 6
TOKENS = (b"\0", b"\xff" * 8, b"{", b"[" * 200, b'"', b"1e999", b"-0", b"NaN", b"null", b"\xc0\x80")


class BrokenError(Exception):
    """Something happened that must never happen; the message holds the input."""


class Target(Protocol):
    """A part of PlugPilot that takes what comes from outside.

    Attributes:
        name: For people.
        tried: Inputs so far.
    """

    name: str
    tried: int

    def run(self, until_s: float) -> None:
        """Try inputs until `time.monotonic` shows this.

        Raises:
            BrokenError: one of them broke something.
        """
        ...


def mutated(data: bytes, rng: random.Random) -> bytes:
    """Bytes that are nearly those given: flipped, cut, doubled, or with something put in."""
    out = bytearray(data)
    for _ in range(rng.randint(1, MOST_CHANGES)):
        at = rng.randrange(len(out) + 1)
        match rng.randrange(5):
            case 0 if out:
                out[at % len(out)] ^= 1 << rng.randrange(8)
            case 1:
                del out[at : at + rng.randint(1, 8)]
            case 2:
                out[at:at] = out[at : at + rng.randint(1, 32)] * rng.randint(1, 4)
            case 3:
                out[at:at] = rng.randbytes(rng.randint(1, 8))
            case _:
                out[at:at] = rng.choice(TOKENS)
    return bytes(out)
