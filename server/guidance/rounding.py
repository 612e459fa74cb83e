"""Numbers for a driver: few digits that do not flicker."""

from __future__ import annotations

_STEPS_CM = ((20.0, 1), (60.0, 5), (float("inf"), 10))
_KEEP = 0.7
"""A shown number stays until the value is so many steps away from it."""


class SteadyNumber:
    """Rounds to whole centimetres, more coarsely far away, and keeps what it showed."""

    def __init__(self) -> None:
        self._shown_cm: int | None = None

    def show(self, distance_mm: float) -> int:
        """The number to show for a distance, at least 1 [cm]."""
        value_cm = abs(distance_mm) / 10.0
        step_cm = next(step for limit, step in _STEPS_CM if value_cm < limit)
        shown = self._shown_cm
        if shown is None or abs(value_cm - shown) > _KEEP * step_cm:
            shown = max(1, round(value_cm / step_cm) * step_cm)
        self._shown_cm = shown
        return shown

    def forget(self) -> None:
        """The next number is another one."""
        self._shown_cm = None
