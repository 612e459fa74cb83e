"""Power and energy of one charging session, as functions of time."""

from __future__ import annotations

import math


class PowerRamp:
    """Power that rises linearly from a moment on and then stays.

    Args:
        from_s: When it begins.
        full_w: What it rises to.
        ramp_s: How long it rises.
    """

    def __init__(self, from_s: float, full_w: float, ramp_s: float) -> None:
        self._from_s = from_s
        self._full_w = full_w
        self._ramp_s = ramp_s

    def power_w(self, t_s: float) -> float:
        """Power at a time [W]."""
        return self._full_w * min(max(t_s - self._from_s, 0.0) / self._ramp_s, 1.0)

    def energy_wh(self, t_s: float) -> float:
        """Energy from the beginning to a time [Wh]."""
        elapsed_s = max(t_s - self._from_s, 0.0)
        rising_s = min(elapsed_s, self._ramp_s)
        joules = self._full_w * (0.5 * rising_s**2 / self._ramp_s + elapsed_s - rising_s)
        return joules / 3600.0

    def reaches_s(self, energy_wh: float) -> float:
        """When that much energy has flowed."""
        joules = energy_wh * 3600.0
        while_rising = 0.5 * self._full_w * self._ramp_s
        if joules <= while_rising:
            return self._from_s + math.sqrt(2.0 * joules * self._ramp_s / self._full_w)
        return self._from_s + self._ramp_s + (joules - while_rising) / self._full_w
