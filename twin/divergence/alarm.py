"""Turns single differences into an alarm that neither flickers nor cries over one noisy sample."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from twin.divergence.findings import Change, Divergence, Place, Residual
from twin.divergence.numbers import AlarmNumbers


class Alarm:
    """The alarm of one quantity.

    It begins when the difference has been above ``raise_sigmas`` without a break for
    ``raise_after_s`` and ``samples`` samples, and ends after ``clear_after_s`` of agreement.

    Args:
        numbers: Thresholds.
        samples: Differences in a row that it takes.
    """

    def __init__(self, numbers: AlarmNumbers, samples: int) -> None:
        self.divergence: Divergence | None = None
        self._numbers = numbers
        self._samples = samples
        self._above = 0
        self._above_since_s = 0.0
        self._below_since_s: float | None = None

    def take(self, residual: Residual, at_s: float, place: Callable[[], Place]) -> Change | None:
        """Judge one comparison; returns what changed.

        Args:
            residual: The comparison.
            at_s: When it was made.
            place: Works out where; asked only when the alarm begins.
        """
        if self.divergence is None:
            return self._maybe_raise(residual, at_s, place)
        if residual.sigmas > self.divergence.largest.sigmas:
            self.divergence = replace(self.divergence, largest=residual)
        return self._maybe_clear(residual, at_s)

    def interrupt(self) -> None:
        """Nothing can be compared just now: what has begun to differ begins anew after that."""
        self._above = 0

    def end(self) -> Change | None:
        """The comparison is no longer possible or no longer matters."""
        self._above = 0
        self._below_since_s = None
        found, self.divergence = self.divergence, None
        return None if found is None else Change(found, began=False)

    def _maybe_raise(
        self, residual: Residual, at_s: float, place: Callable[[], Place]
    ) -> Change | None:
        if residual.sigmas <= self._numbers.raise_sigmas:
            self._above = 0
            return None
        if self._above == 0:
            self._above_since_s = at_s
        self._above += 1
        lasted_s = at_s - self._above_since_s
        # one sighting is a measurement by itself: it need not last
        needed_s = self._numbers.raise_after_s if self._samples > 1 else 0.0
        if self._above < self._samples or lasted_s < needed_s:
            return None
        self.divergence = Divergence(residual, place(), residual)
        return Change(self.divergence, began=True)

    def _maybe_clear(self, residual: Residual, now_s: float) -> Change | None:
        if residual.sigmas >= self._numbers.clear_sigmas:
            self._below_since_s = None
            return None
        if self._below_since_s is None:
            self._below_since_s = now_s
        if now_s - self._below_since_s < self._numbers.clear_after_s:
            return None
        return self.end()
