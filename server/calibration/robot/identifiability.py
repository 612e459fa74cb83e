"""What the looks have told, and what only the drawing says.

In units of what was known beforehand, the eigenvectors of the posterior covariance are the
combinations of unknowns, and their eigenvalues say how much of the doubt is left: near 0 the
looks decided, near 1 they said nothing.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from server.calibration.robot.known_before import KnownBefore
from server.calibration.robot.unknowns import NAMES

Array = NDArray[np.float64]

UNSEEN = 0.5
"""A combination with more than this share of its doubt left was not seen."""

_NAMED = 0.2
"""Unknowns with a smaller share of a combination are not named."""


@dataclass(frozen=True, slots=True)
class Combination:
    """A direction in the space of the unknowns.

    Attributes:
        doubt_left: Its standard deviation after over the one before, 0 to 1.
        parts: The unknowns that make it up, largest first, with their shares, signed.
    """

    doubt_left: float
    parts: tuple[tuple[str, float], ...]

    @property
    def seen(self) -> bool:
        """Whether the looks decided it."""
        return self.doubt_left <= UNSEEN


def combinations(covariance: Array, known: KnownBefore) -> tuple[Combination, ...]:
    """All independent combinations of what was known beforehand, the least seen first.

    Args:
        covariance: Of the unknowns after the fit, shape (14, 14).
        known: Beforehand.
    """
    finite = np.flatnonzero(np.isfinite(known.sigma))
    sigma = known.sigma[finite]
    scaled = covariance[np.ix_(finite, finite)] / np.outer(sigma, sigma)
    values, vectors = np.linalg.eigh(scaled)
    found = []
    for value, vector in zip(values[::-1], vectors.T[::-1], strict=True):
        order = np.argsort(-np.abs(vector))
        parts = tuple(
            (NAMES[finite[place]], round(float(vector[place]), 3))
            for place in order
            if abs(vector[place]) >= _NAMED
        )
        found.append(Combination(float(np.sqrt(max(value, 0.0))), parts))
    return tuple(found)
