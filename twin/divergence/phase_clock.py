"""How long a phase of a job should take."""

from __future__ import annotations

from twin.divergence.findings import Quantity, Residual
from twin.divergence.numbers import TimeNumbers


class PhaseClock:
    """Compares the length of a phase with its planned motions and what it usually needs besides.

    Only a phase that takes too long counts.

    Args:
        numbers: What each phase needs besides its motions.
    """

    def __init__(self, numbers: TimeNumbers) -> None:
        self.phase = ""
        self._numbers = numbers
        self._began_s = 0.0
        self._sent_before_s = 0.0

    def begin(self, phase: str, now_s: float, sent_s: float) -> None:
        """A phase begins.

        Args:
            phase: Its name; empty when the job is over.
            now_s: When.
            sent_s: Length of all motions that were sent before it.
        """
        self.phase, self._began_s, self._sent_before_s = phase, now_s, sent_s

    def compare(self, now_s: float, sent_s: float) -> Residual | None:
        """The comparison now; None for a phase without expectations."""
        usual = self._numbers.phases.get(self.phase)
        if usual is None:
            return None
        expected_s = sent_s - self._sent_before_s + usual.typical_s
        return Residual(
            Quantity.PHASE_TIME,
            expected=expected_s,
            measured=max(now_s - self._began_s, expected_s),
            sigma=usual.sigma_s,
            unit="s",
        )
