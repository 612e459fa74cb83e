"""The least and the greatest of a measure over a rectangle, with the height where it is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from twin.geometry import RobotGeometry
from twin.workspace.boundary import Array, Point
from twin.workspace.errors import SingularRectangleError
from twin.workspace.interval import least_on
from twin.workspace.leg_flanks import leg_band
from twin.workspace.margins import require_fit
from twin.workspace.measures import NO_FORCE, Measure, measure_rows
from twin.workspace.planar_force import PlanarForce
from twin.workspace.rectangle import Rectangle

SINGULAR = 1e-9
"""d / L or (d1 h2 + d2 h1) / L^2 below this counts as a singularity."""

_UNBOUNDED_IN_LINE = {
    Measure.CONDITION,
    Measure.FORCE1,
    Measure.FORCE2,
    Measure.SPEED_MIN,
    Measure.SPEED_MAX,
}
"""Measures that have no bound, or no value, where the legs are in line."""


@dataclass(frozen=True, slots=True)
class Extreme:
    """An extreme value and a position of V that has it; so has the whole row at its height."""

    value: float
    at: Point


@dataclass(frozen=True, slots=True)
class Extremes:
    """Least and greatest value over a rectangle."""

    least: Extreme
    greatest: Extreme


def worst_over(
    geometry: RobotGeometry,
    rectangle: Rectangle,
    measure: Measure,
    force: PlanarForce = NO_FORCE,
) -> Extremes:
    """Extremes of a measure over the whole rectangle.

    Raises:
        RectangleOutsideError: not all of the rectangle is reached.
        SingularRectangleError: it touches a singularity, where the measure has no bound.
    """
    require_fit(geometry, rectangle)
    band = leg_band(geometry)
    low_mm = max(rectangle.y_min_mm, band.y_low_mm)
    high_mm = min(rectangle.y_max_mm, band.y_high_mm)
    _require_bound(geometry, measure, np.array([low_mm, high_mm]))

    def rows(y_mm: Array) -> Array:
        return measure_rows(geometry, measure, y_mm, force)

    least_y_mm, least = least_on(rows, low_mm, high_mm)
    greatest_y_mm, negative = least_on(lambda y_mm: -rows(y_mm), low_mm, high_mm)
    return Extremes(
        Extreme(least, Point(rectangle.center_x_mm, least_y_mm)),
        Extreme(-negative, Point(rectangle.center_x_mm, greatest_y_mm)),
    )


def _require_bound(geometry: RobotGeometry, measure: Measure, edges_mm: Array) -> None:
    """The legs are in line or upright at the lowest or the highest height first."""
    checks = []
    if measure in _UNBOUNDED_IN_LINE:
        checks.append((Measure.DETERMINANT, geometry.leg_length_mm**2, "the legs are in line"))
    if measure is Measure.CONDITION:
        checks.append((Measure.D1, geometry.leg_length_mm, "the left leg stands upright"))
        checks.append((Measure.D2, geometry.leg_length_mm, "the right leg stands upright"))
    for quantity, unit, sentence in checks:
        ratios = measure_rows(geometry, quantity, edges_mm) / unit
        if (ratios < SINGULAR).any():
            y_mm = float(edges_mm[int(np.argmin(ratios))])
            msg = f"{measure.value} has no bound: at y = {y_mm:.1f} mm {sentence}"
            raise SingularRectangleError(msg, {"measure": measure.value, "y_mm": y_mm})
