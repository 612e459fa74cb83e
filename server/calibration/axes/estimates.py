"""What repeated measurements of one axis say, with how sure they are of it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Estimate:
    """A number and its standard deviation, in the same unit."""

    value: float
    sigma: float


def switch_spread(closed_at_mm: Array) -> Estimate:
    """Standard deviation of where a switch closes.

    The standard deviation of a sample deviation s of n values is s / sqrt(2 (n - 1)).

    Args:
        closed_at_mm: Step counts at which it closed, all approached from the same side, shape (n,)
            [mm].

    Raises:
        ValueError: there are fewer than three.
    """
    _require(closed_at_mm, 3, "approaches of the switch")
    spread_mm = float(np.std(closed_at_mm, ddof=1))
    return Estimate(spread_mm, spread_mm / math.sqrt(2 * (len(closed_at_mm) - 1)))


def spread_between(groups_mm: Array) -> Estimate:
    """Standard deviation between groups, without what differs within a group.

    One-way random effects (Searle 1971): with k values in each group, the mean of a group spreads
    by the variance between the groups plus a k-th of that within them.

    Args:
        groups_mm: Such as repeated looks after each homing, shape (n, k) [mm].

    Raises:
        ValueError: there are fewer than three groups, or fewer than two values in each.
    """
    _require(groups_mm, 3, "approaches of the switch")
    _require(groups_mm.T, 2, "looks after each approach")
    n, k = groups_mm.shape
    of_means = float(np.var(groups_mm.mean(axis=1), ddof=1))
    within = float(np.mean(np.var(groups_mm, axis=1, ddof=1)))
    between_mm = math.sqrt(max(of_means - within / k, 0.0))
    return Estimate(between_mm, math.sqrt(of_means) / math.sqrt(2 * (n - 1)))


def belt_scale(commanded_mm: float, measured_mm: float, reading_sigma_mm: float) -> Estimate:
    """True travel over the commanded one.

    Args:
        commanded_mm: Distance between two places by the board's counting, approached from the same
            side so that play cancels [mm].
        measured_mm: The same with a rule [mm].
        reading_sigma_mm: How exactly each end of the rule was read [mm].

    Raises:
        ValueError: there is no distance.
    """
    if not abs(commanded_mm) > 0:
        raise ValueError("a belt is measured over a distance greater than zero")
    sigma = math.sqrt(2) * reading_sigma_mm / abs(commanded_mm)
    return Estimate(measured_mm / commanded_mm, sigma)


def play(from_below_mm: Array, from_above_mm: Array) -> Estimate:
    """Play of an axis: what it stands lower after coming from below than from above.

    Args:
        from_below_mm: Where it stood, same command each time, approached from below, shape (n,).
        from_above_mm: The same from above, shape (m,) [mm].

    Raises:
        ValueError: a side has fewer than three.
    """
    _require(from_below_mm, 3, "approaches from below")
    _require(from_above_mm, 3, "approaches from above")
    difference = float(np.mean(from_above_mm) - np.mean(from_below_mm))
    variance = np.var(from_below_mm, ddof=1) / len(from_below_mm)
    variance += np.var(from_above_mm, ddof=1) / len(from_above_mm)
    return Estimate(difference, math.sqrt(float(variance)))


def _require(values: Array, fewest: int, what: str) -> None:
    if len(values) < fewest:
        raise ValueError(f"{len(values)} {what}; at least {fewest} are needed")
