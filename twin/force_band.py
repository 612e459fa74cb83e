"""The forces that a plug may meet at each depth of its socket."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from itertools import pairwise
from statistics import fmean, stdev

Point = tuple[float, float, float]
"""Depth behind the socket's face [mm], smallest and largest force there [N]."""

Curve = Sequence[tuple[float, float]]
"""(Depth [mm], force [N]) along one insertion or withdrawal."""

ALONE_MM = 2.0
"""Around a depth without neighbours this much counts."""


class ForceBand:
    """Smallest and largest force over depth, linear between points and constant outside.

    Args:
        points: In ascending depth, one or more.

    Raises:
        ValueError: no points, a depth that does not ascend, or a band that is upside down.
    """

    def __init__(self, points: Sequence[Point]) -> None:
        if not points:
            raise ValueError("a force band needs at least one point")
        if any(b[0] <= a[0] for a, b in pairwise(points)):
            raise ValueError("the depths of a force band must ascend")
        if any(lower_n >= upper_n for _, lower_n, upper_n in points):
            raise ValueError("in a force band the smallest force must be below the largest one")
        self.points = tuple(points)
        self._depths = [point[0] for point in points]

    def at(self, depth_mm: float) -> tuple[float, float]:
        """Smallest and largest force at a depth [N]."""
        index = bisect_right(self._depths, depth_mm)
        if index == 0:
            return self.points[0][1:]
        if index == len(self.points):
            return self.points[-1][1:]
        (d0, low0, high0), (d1, low1, high1) = self.points[index - 1], self.points[index]
        share = (depth_mm - d0) / (d1 - d0)
        return low0 + share * (low1 - low0), high0 + share * (high1 - high0)


def learn_band(
    curves: Sequence[Curve],
    depths_mm: Sequence[float],
    *,
    sigmas: float = 6.0,
    margin_n: float = 5.0,
    limit_n: float = math.inf,
) -> ForceBand:
    """The band of the good insertions of one socket: mean, plus and minus some deviations.

    At each depth the forces of all curves within half the way to the neighbouring depths count,
    one mean for each curve. The deviation is that between the curves, and with few of them it is
    widened as a prediction interval is: by sqrt(1 + 1/n).

    Args:
        curves: Of three or more good insertions.
        depths_mm: Where the band gets its points, ascending; those without data are left out.
        sigmas: Half the width of the band in standard deviations.
        margin_n: Half the width that is added to that: noise, and what differs from day to day.
        limit_n: The band ends here in any case.

    Raises:
        ValueError: too few curves, or none of the depths was reached by all of them.
    """
    if len(curves) < 3:
        raise ValueError("a force band is learnt from three or more insertions")
    points: list[Point] = []
    for depth_mm, half_mm in _windows(depths_mm):
        means = [
            fmean(inside)
            for curve in curves
            if (inside := [f for d, f in curve if abs(d - depth_mm) <= half_mm])
        ]
        if len(means) < len(curves):
            continue
        width_n = sigmas * stdev(means) * math.sqrt(1 + 1 / len(means)) + margin_n
        middle_n = fmean(means)
        upper_n = min(middle_n + width_n, limit_n)
        points.append((depth_mm, min(middle_n, upper_n) - width_n, upper_n))
    if not points:
        raise ValueError("the insertions have no depth in common")
    return ForceBand(points)


def _windows(depths_mm: Sequence[float]) -> list[tuple[float, float]]:
    """Each depth with half the way to its nearest neighbour."""
    gaps = [b - a for a, b in pairwise(depths_mm)]
    first, last = (gaps[0], gaps[-1]) if gaps else (ALONE_MM, ALONE_MM)
    nearest = [min(a, b) for a, b in zip([first, *gaps], [*gaps, last], strict=True)]
    return [(depth, gap / 2) for depth, gap in zip(depths_mm, nearest, strict=True)]
