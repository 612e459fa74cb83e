"""What a person latches by pressing stop, and what releases it."""

from __future__ import annotations


class Latches:
    """Protective stop and emergency stop.

    Releasing takes its time. A stop that is pressed meanwhile must not be released with the one
    before, so presses are counted.
    """

    def __init__(self) -> None:
        self.stopped = False
        self.emergency = False
        self.presses = 0

    def press_stop(self) -> None:
        """Latch the protective stop."""
        self.stopped = True
        self.presses += 1

    def press_emergency_stop(self) -> None:
        """Latch the emergency stop."""
        self.emergency = True
        self.presses += 1

    def release(self, presses: int) -> bool:
        """Release everything, unless somebody has pressed again; returns whether it did.

        Args:
            presses: ``self.presses`` when the release was asked for.
        """
        if self.presses != presses:
            return False
        self.stopped = self.emergency = False
        return True
