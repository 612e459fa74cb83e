"""One independent stream of random numbers per subject, all drawn from one seed.

A stream belongs to its subject by position in ``Streams``: adding one at the end leaves all the
others, and with them every recorded run, as they were.
"""

from __future__ import annotations

from typing import NamedTuple, Self

import numpy as np


class Streams(NamedTuple):
    """Generators, independent of each other."""

    build: np.random.Generator
    car: np.random.Generator
    power_up: np.random.Generator
    homing: np.random.Generator
    force: np.random.Generator
    telemetry: np.random.Generator
    station: np.random.Generator
    optics: np.random.Generator
    contact: np.random.Generator

    @classmethod
    def from_seed(cls, seed: int) -> Self:
        """The streams of one garage."""
        children = np.random.SeedSequence(seed).spawn(len(cls._fields))
        return cls(*(np.random.default_rng(child) for child in children))


def clipped_normal(rng: np.random.Generator, std: float, largest: float) -> float:
    """A normally distributed number, cut off at plus and minus ``largest``."""
    return float(np.clip(rng.normal(0.0, std), -largest, largest))
