"""Pose accuracy and repeatability of one place (ISO 9283:1998, clauses 7.2.1 to 7.2.3).

A place is approached n times; with p_j where the robot came to and c where it was sent,

    AP = |mean(p) - c|,    l_j = |p_j - mean(p)|,    RP = mean(l) + 3 S_l,

S_l being the standard deviation of l with n - 1. Approached from several directions h, the
multidirectional variation vAP is the largest distance between the means of two directions. Only
places count: this robot does not turn.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

FEWEST_APPROACHES = 3
"""Of one place from one direction; the standard itself asks for 30."""


@dataclass(frozen=True, slots=True, eq=False)
class PlaceResult:
    """One place.

    Attributes:
        commanded_mm: Where the robot was sent, shape (d,).
        mean_mm: Where it came to on average, shape (d,).
        accuracy_mm: AP.
        repeatability_mm: RP, over all approaches.
        direction_variation_mm: vAP; 0 with one direction.
        approaches: How many.
    """

    commanded_mm: Array
    mean_mm: Array
    accuracy_mm: float
    repeatability_mm: float
    direction_variation_mm: float
    approaches: int


def place_result(commanded_mm: Array, attained_mm: Mapping[str, Array]) -> PlaceResult:
    """Judge one place.

    Args:
        commanded_mm: Where the robot was sent, shape (d,) [mm].
        attained_mm: Where it came to, by direction of approach, shape (n, d) each [mm].

    Raises:
        ValueError: a direction has fewer than `FEWEST_APPROACHES` approaches.
    """
    for direction, attained in attained_mm.items():
        if len(attained) < FEWEST_APPROACHES:
            msg = (
                f"{len(attained)} approaches from {direction}; at least {FEWEST_APPROACHES} are "
                "needed to say how well they repeat"
            )
            raise ValueError(msg)
    everything = np.concatenate(list(attained_mm.values()))
    mean = everything.mean(axis=0)
    lengths = np.linalg.norm(everything - mean, axis=1)
    means = [attained.mean(axis=0) for attained in attained_mm.values()]
    return PlaceResult(
        commanded_mm=commanded_mm,
        mean_mm=mean,
        accuracy_mm=float(np.linalg.norm(mean - commanded_mm)),
        repeatability_mm=float(lengths.mean() + 3.0 * lengths.std(ddof=1)),
        direction_variation_mm=max(
            (float(np.linalg.norm(a - b)) for a, b in combinations(means, 2)), default=0.0
        ),
        approaches=len(everything),
    )
