"""Does a station still live, or does something repeat an old answer?"""

from __future__ import annotations

from drivers.station.errors import StationStaleError


class ClockWatch:
    """Watches a value that changes by itself: a clock, a time since the start.

    Only that it changes matters. A clock that was set or jumps back is none the worse for it.

    Args:
        name: Name of the station.
        patience_s: So long it may stay the same.
    """

    def __init__(self, name: str, patience_s: float) -> None:
        self._name = name
        self._patience_s = patience_s
        self._value: object = None
        self._since_s: float | None = None

    def check(self, value: object, asked_s: float) -> None:
        """Look at a new answer.

        Args:
            value: What the station's clock says; None when it has none, which proves nothing.
            asked_s: When it was asked, event loop time [s].

        Raises:
            StationStaleError: the value has been the same for too long.
        """
        if value is None or value != self._value or self._since_s is None:
            self._value, self._since_s = value, asked_s
            return
        same_s = asked_s - self._since_s
        if same_s > self._patience_s:
            raise StationStaleError(
                f"{self._name} has repeated the same moment for {same_s:.1f} s. "
                "Restart it, and take away any proxy before it."
            )
