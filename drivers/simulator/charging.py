"""Power and energy of one charging session, as functions of time."""

from __future__ import annotations

import math


class PowerRamp:
    """Power that changes linearly from a moment on and then stays.

    Args:
        from_s: When it begins.
        full_w: What it changes to.
        ramp_s: How long it changes.
        first_w: What it changes from.
    """

    def __init__(self, from_s: float, full_w: float, ramp_s: float, first_w: float = 0.0) -> None:
        self._from_s = from_s
        self._full_w = full_w
        self._ramp_s = ramp_s
        self._first_w = first_w

    def power_w(self, t_s: float) -> float:
        """Power at a time [W]."""
        part = min(max(t_s - self._from_s, 0.0) / self._ramp_s, 1.0)
        return self._first_w + (self._full_w - self._first_w) * part

    def energy_wh(self, t_s: float) -> float:
        """Energy from the beginning to a time [Wh]."""
        elapsed_s = max(t_s - self._from_s, 0.0)
        changing_s = min(elapsed_s, self._ramp_s)
        joules = (
            self._first_w * changing_s
            + 0.5 * (self._full_w - self._first_w) * changing_s**2 / self._ramp_s
            + self._full_w * (elapsed_s - changing_s)
        )
        return joules / 3600.0

    def reaches_s(self, energy_wh: float) -> float:
        """When that much energy has flowed."""
        joules = energy_wh * 3600.0
        while_changing = 0.5 * (self._first_w + self._full_w) * self._ramp_s
        if joules > while_changing:
            return self._from_s + self._ramp_s + (joules - while_changing) / self._full_w
        # the positive root of first_w t + (full_w - first_w) t^2 / (2 ramp_s) = joules, in the
        # form that also holds for a straight line
        slope = (self._full_w - self._first_w) / self._ramp_s
        root = math.sqrt(max(self._first_w**2 + 2.0 * slope * joules, 0.0))
        return self._from_s + (2.0 * joules / (self._first_w + root) if joules > 0 else 0.0)
