"""Where the joints should be: the carriages at their set points, the slide a lag behind or less."""

from __future__ import annotations

import math

from twin.divergence.findings import Quantity, Residual
from twin.divergence.numbers import TrackingNumbers
from twin.divergence.samples import Sample

LONGEST_GAP_S = 0.15
"""Longer without a sample, and nobody knows what the set point did in between."""


class FirstOrderLag:
    """Follows a set point as a first-order system does, exactly between samples.

    With the set point u(t) = u0 + v0 t + a t^2 / 2 the solution of x' = (u - x) / tau is
    x = u - tau u' + tau^2 a + c exp(-t / tau), where c makes x start where it was.

    Args:
        lag_s: tau.
    """

    def __init__(self, lag_s: float) -> None:
        self._lag_s = lag_s
        self._x_mm: float | None = None
        self._at_s = self._u_mm = self._v_mm_s = 0.0

    def reset(self) -> None:
        """The next set point is a new beginning."""
        self._x_mm = None

    def follow(self, at_s: float, u_mm: float, v_mm_s: float, measured_mm: float) -> float:
        """Where the joint should be [mm].

        Args:
            at_s: When.
            u_mm: Set point.
            v_mm_s: Its velocity.
            measured_mm: Where the joint is: believed at a new beginning only.
        """
        elapsed_s = at_s - self._at_s
        if self._x_mm is None or not 0 < elapsed_s <= LONGEST_GAP_S:
            # A joint at rest stands at its set point; one that is met in motion is believed.
            self._x_mm = u_mm if v_mm_s == 0 else measured_mm
        else:
            self._x_mm = self._followed(self._x_mm, elapsed_s, u_mm)
        self._at_s, self._u_mm, self._v_mm_s = at_s, u_mm, v_mm_s
        return self._x_mm

    def _followed(self, x_mm: float, elapsed_s: float, u_mm: float) -> float:
        tau = self._lag_s
        # the parabola that leaves with the old velocity and arrives at the new set point
        a = 2 * (u_mm - self._u_mm - self._v_mm_s * elapsed_s) / elapsed_s**2
        c = x_mm - (self._u_mm - tau * self._v_mm_s + tau * tau * a)
        v_mm_s = self._v_mm_s + a * elapsed_s
        return u_mm - tau * v_mm_s + tau * tau * a + c * math.exp(-elapsed_s / tau)


class Tracking:
    """Compares the measured joints with where the model has them.

    The carriages are open-loop steppers: what is measured of them are steps, so a carriage that
    slips or is pushed does not show here. The slide has an encoder. It may be anywhere between its
    set point and the usual lag behind that: a board that feeds the speed forward has hardly any.

    The standard deviation of a carriage is that of its steps and of the time between set point
    and count; that of the slide also has the spread of its lag and its give under load:
    sigma^2 = s^2 + (v sigma_t)^2 + (v sigma_tau)^2 + (F g)^2.

    Args:
        numbers: Lag and spreads.
    """

    def __init__(self, numbers: TrackingNumbers) -> None:
        self._numbers = numbers
        self._slide = FirstOrderLag(numbers.slide_lag_s)
        self._last_slide_mm_s = 0.0

    def reset(self) -> None:
        """The set point goes its own way: begin anew after that."""
        self._slide.reset()

    def compare(self, sample: Sample) -> list[Residual]:
        """One comparison for each joint."""
        n, velocity = self._numbers, sample.velocity
        slide_mm = self._slide.follow(
            sample.at_s, sample.commanded.rho3_mm, velocity.rho3_mm_s, sample.measured.rho3_mm
        )
        lowest_mm, highest_mm = sorted((slide_mm, sample.commanded.rho3_mm))
        slide_mm = min(max(sample.measured.rho3_mm, lowest_mm), highest_mm)
        # Lags matter as long as the joint still catches up after its set point has stopped.
        slide_mm_s = max(abs(velocity.rho3_mm_s), self._last_slide_mm_s * 0.7)
        self._last_slide_mm_s = slide_mm_s
        slide_sigma_mm = math.hypot(
            n.slide_sigma_mm,
            slide_mm_s * n.sample_sigma_s,
            slide_mm_s * n.slide_lag_sigma_s,
            sample.force_n * n.slide_give_mm_n,
        )
        return [
            *(
                Residual(
                    quantity,
                    expected=sample.commanded[joint],
                    measured=sample.measured[joint],
                    sigma=math.hypot(n.rail_sigma_mm, velocity[joint] * n.sample_sigma_s),
                    unit="mm",
                )
                for joint, quantity in enumerate((Quantity.RHO1, Quantity.RHO2))
            ),
            Residual(Quantity.RHO3, slide_mm, sample.measured.rho3_mm, slide_sigma_mm, unit="mm"),
        ]
