"""What latches a stop, and what releases it."""

from __future__ import annotations

from server.control.stop_cause import PRESSED, StopCause


class Latches:
    """Protective stop and emergency stop.

    Releasing takes its time. A stop that is pressed meanwhile must not be released with the one
    before, so presses are counted.

    Attributes:
        cause: Why the protective stop is in force; None while there is none. What a person
            pressed is never replaced by what a watchdog found.
        emergency: The emergency stop is in force.
        presses: How often anything was latched.
    """

    def __init__(self) -> None:
        self.cause: StopCause | None = None
        self.emergency = False
        self.presses = 0

    @property
    def stopped(self) -> bool:
        """A protective stop is in force."""
        return self.cause is not None

    def press_stop(self, cause: StopCause = PRESSED) -> None:
        """Latch the protective stop."""
        if self.cause is None or not self.cause.by_person:
            self.cause = cause
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
        self.cause, self.emergency = None, False
        return True
