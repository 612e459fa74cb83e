"""The power a car charges with, without its noise."""

from __future__ import annotations

import math

from server.jobs.phases.charging import STANDBY_W

SMOOTHING_S = 30.0
"""Time constant of the mean."""

SAME_POWER = 0.2
"""What differs more from the mean is another power, of which the mean knows nothing."""

SETTLES_S = 3.0
"""A car takes its time from one power to the next; before that nothing is told of the new one."""


class SteadyPower:
    """A mean that follows noise slowly and a change of the power at once.

    Attributes:
        power_w: What the car charges with; None while it does not, or not yet evenly.
    """

    def __init__(self) -> None:
        self.power_w: float | None = None
        self._mean_w = 0.0
        self._since_s = 0.0
        self._read_s = -math.inf

    def read(self, power_w: float, at_s: float) -> None:
        """Take in a reading; one that is not newer than the last adds nothing.

        Args:
            power_w: Of the station.
            at_s: When it was measured, event loop time.
        """
        if at_s <= self._read_s:
            return
        passed_s, self._read_s = at_s - self._read_s, at_s
        if power_w <= STANDBY_W:
            self.power_w, self._mean_w = None, 0.0
            return
        if abs(power_w - self._mean_w) > SAME_POWER * self._mean_w:
            self._mean_w, self._since_s = power_w, at_s
        else:
            self._mean_w += (power_w - self._mean_w) * -math.expm1(-passed_s / SMOOTHING_S)
        if at_s - self._since_s >= SETTLES_S:
            self.power_w = self._mean_w

    def forget(self) -> None:
        """It charges no more, or another job does."""
        self.power_w, self._mean_w = None, 0.0
