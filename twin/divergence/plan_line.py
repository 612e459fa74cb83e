"""Where the board's set point should be by the segments that it was sent."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence

from twin.divergence.findings import Quantity, Residual
from twin.divergence.numbers import SetPointNumbers
from twin.divergence.samples import Sample
from twin.motion.segments import Segment

KEPT_S = 1.0
"""Segments that ended longer ago are forgotten."""

SAME_PLACE_MM = 0.05


class PlanLine:
    """The segments sent, laid out in time.

    The first segment of a motion begins ``start_delay_s`` after it was sent; each later one where
    the one before it ends. How sure that is grows with the speed:
    sigma^2 = s^2 + (v sigma_t)^2.

    Args:
        numbers: Delay and spreads.

    Attributes:
        sent_s: Length of all segments sent so far.
    """

    def __init__(self, numbers: SetPointNumbers) -> None:
        self.sent_s = 0.0
        self._numbers = numbers
        self._segments: deque[tuple[float, Segment]] = deque()

    def append(self, segments: Sequence[Segment], now_s: float) -> None:
        """Segments were sent now."""
        begins_s = now_s + self._numbers.start_delay_s
        if self._segments and not self._continues(segments):
            self.drop()  # a stop has emptied the board's queue
        if self._segments:
            last_s, last = self._segments[-1]
            begins_s = max(begins_s, last_s + last.duration_s)
        for segment in segments:
            self._segments.append((begins_s, segment))
            begins_s += segment.duration_s
            self.sent_s += segment.duration_s

    def drop(self) -> None:
        """The board follows the segments no longer."""
        self._segments.clear()

    def compare(self, sample: Sample) -> Residual | None:
        """The joint whose set point is furthest from the plan; None where no plan says anything."""
        n = self._numbers
        while self._segments and self._end_s(0) < sample.at_s - KEPT_S:
            self._segments.popleft()
        found = self._segment_at(sample.at_s)
        if found is None:
            return None
        begins_s, segment = found
        t_s = sample.at_s - begins_s
        expected, velocity = segment.position_at(t_s), segment.velocity_at(t_s)
        residuals = [
            Residual(
                Quantity.SET_POINT,
                expected=expected[joint],
                measured=sample.commanded[joint],
                sigma=math.hypot(
                    n.sigma_mm,
                    max(abs(velocity[joint]), abs(sample.velocity[joint])) * n.delay_sigma_s,
                ),
                unit="mm",
            )
            for joint in range(3)
        ]
        return max(residuals, key=lambda residual: residual.sigmas)

    def _continues(self, segments: Sequence[Segment]) -> bool:
        _, last = self._segments[-1]
        return bool(segments) and math.dist(last.end, segments[0].start) < SAME_PLACE_MM

    def _end_s(self, index: int) -> float:
        begins_s, segment = self._segments[index]
        return begins_s + segment.duration_s

    def _segment_at(self, at_s: float) -> tuple[float, Segment] | None:
        for begins_s, segment in self._segments:
            if begins_s <= at_s < begins_s + segment.duration_s:
                return begins_s, segment
        return None
