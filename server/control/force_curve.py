"""Force over depth of one motion of the plug, as it was measured."""

from __future__ import annotations

from statistics import fmean, median

from twin.force_band import Curve

SAMPLES = 5
"""The median of so many samples counts: 50 ms, in which one noisy sample means nothing. The board
caps the force by itself without any delay."""


class ForceCurve:
    """Samples of depth and force in the order of time, smoothed by a running median."""

    def __init__(self) -> None:
        self._depths_mm: list[float] = []
        self._raw_n: list[float] = []
        self._points: list[tuple[float, float]] = []

    @property
    def points(self) -> Curve:
        """(Depth [mm], force [N]) of the middle of each window of samples."""
        return self._points

    @property
    def largest_push_n(self) -> float:
        """Largest force towards the car, 0 if there was none [N]."""
        return max([0.0, *(force for _, force in self._points)])

    @property
    def largest_pull_n(self) -> float:
        """Largest force away from the car, 0 if there was none [N]."""
        return max([0.0, *(-force for _, force in self._points)])

    def add(self, depth_mm: float, force_n: float) -> tuple[float, float] | None:
        """Take in a sample.

        Returns:
            The newest smoothed point; None before there are enough samples.
        """
        self._depths_mm.append(depth_mm)
        self._raw_n.append(force_n)
        if len(self._raw_n) < SAMPLES:
            return None
        point = (self._depths_mm[-1 - SAMPLES // 2], median(self._raw_n[-SAMPLES:]))
        self._points.append(point)
        return point

    def final_stiffness_n_mm(self, over_mm: float = 0.3) -> float:
        """How steeply the force has risen over the last bit of the way in [N/mm].

        The raw samples count: a hard stop takes less time than the median looks back.

        Args:
            over_mm: About so long a bit of the way.
        """
        if not self._raw_n:
            return 0.0
        deepest_mm = max(self._depths_mm)
        before = [
            (depth, force)
            for depth, force in zip(self._depths_mm, self._raw_n, strict=True)
            if deepest_mm - 2 * over_mm <= depth <= deepest_mm - over_mm
        ]
        if not before:
            return 0.0
        way_mm = deepest_mm - fmean(depth for depth, _ in before)
        return (max(self._raw_n[-2 * SAMPLES :]) - fmean(force for _, force in before)) / way_mm

    def summary(self, step_mm: float = 2.0) -> list[tuple[float, float]]:
        """A few points of it for a journal: mean force in steps of depth."""
        bins: dict[int, list[float]] = {}
        for depth_mm, force_n in self._points:
            bins.setdefault(round(depth_mm / step_mm), []).append(force_n)
        return [(step_mm * i, round(fmean(forces), 1)) for i, forces in sorted(bins.items())]
