"""How much stroke a rectangle leaves, at its worst point for each limit.

rho1 = x - a - d1(y) and rho2 = b - x - d2(y) grow or fall evenly along x, and d(y) =
sqrt(L^2 - (y - e_y)^2) is concave. So the least rho lies at the height of the rectangle nearest to
the carriage's, which may be in the middle of a vertical edge, and the greatest rho at the corner
farthest from it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from twin.geometry import RobotGeometry
from twin.workspace.boundary import Limit, Point
from twin.workspace.errors import RectangleOutsideError
from twin.workspace.leg_flanks import foot_abscissae, leg_band
from twin.workspace.rectangle import Rectangle

FIT_TOLERANCE_MM = 1e-9
"""A rectangle that leaves this much less than nothing still fits: rounding."""


@dataclass(frozen=True, slots=True)
class Margin:
    """What is left before a limit at the worst point.

    Attributes:
        value_mm: Stroke left, or for the legs' own limits height left; negative where it lacks.
        at: The worst position of V.
        limit: The limit.
    """

    value_mm: float
    at: Point
    limit: Limit


@dataclass(frozen=True, slots=True)
class StrokeMargins:
    """Margins of a set of positions of V to every limit of the reachable region.

    Where the legs do not reach a height at all, their margins count as if they lay flat there;
    `leg_length` or `assembly_side` is negative then.

    Attributes:
        rho1_min: Stroke left before rho1 is at its start.
        rho1_max: Stroke left before rho1 is at its end.
        rho2_min: Stroke left before rho2 is at its start.
        rho2_max: Stroke left before rho2 is at its end.
        assembly_side: Height above the legs' flat position.
        leg_length: Height left before a leg stands upright.
    """

    rho1_min: Margin
    rho1_max: Margin
    rho2_min: Margin
    rho2_max: Margin
    assembly_side: Margin
    leg_length: Margin

    @property
    def all(self) -> tuple[Margin, ...]:
        """All six."""
        return (
            self.rho1_min,
            self.rho1_max,
            self.rho2_min,
            self.rho2_max,
            self.assembly_side,
            self.leg_length,
        )

    @property
    def smallest(self) -> Margin:
        """The one that is used up first."""
        return min(self.all, key=lambda margin: margin.value_mm)

    @property
    def fits(self) -> bool:
        """Whether all positions are reached."""
        return self.smallest.value_mm >= -FIT_TOLERANCE_MM


def stroke_margins(geometry: RobotGeometry, rectangle: Rectangle) -> StrokeMargins:
    """Margins of the whole rectangle, exact."""
    a, b = foot_abscissae(geometry)
    x_min_mm, x_max_mm = rectangle.x_min_mm, rectangle.x_max_mm
    near1, far1 = nearest_height(rectangle, geometry.e1y_mm), _farthest(rectangle, geometry.e1y_mm)
    near2, far2 = nearest_height(rectangle, geometry.e2y_mm), _farthest(rectangle, geometry.e2y_mm)
    rho1_least = x_min_mm - a - reach_mm(geometry, near1 - geometry.e1y_mm)
    rho1_greatest = x_max_mm - a - reach_mm(geometry, far1 - geometry.e1y_mm)
    rho2_least = b - x_max_mm - reach_mm(geometry, near2 - geometry.e2y_mm)
    rho2_greatest = b - x_min_mm - reach_mm(geometry, far2 - geometry.e2y_mm)
    low, high = leg_band(geometry)[:2]
    return StrokeMargins(
        Margin(rho1_least - geometry.rho1.min_mm, Point(x_min_mm, near1), Limit.RHO1_MIN),
        Margin(geometry.rho1.max_mm - rho1_greatest, Point(x_max_mm, far1), Limit.RHO1_MAX),
        Margin(rho2_least - geometry.rho2.min_mm, Point(x_max_mm, near2), Limit.RHO2_MIN),
        Margin(geometry.rho2.max_mm - rho2_greatest, Point(x_min_mm, far2), Limit.RHO2_MAX),
        Margin(rectangle.y_min_mm - low, rectangle.corners[0], Limit.ASSEMBLY_SIDE),
        Margin(high - rectangle.y_max_mm, rectangle.corners[2], Limit.LEG_LENGTH),
    )


def fits(geometry: RobotGeometry, rectangle: Rectangle) -> bool:
    """Whether every position of the rectangle is reached."""
    return stroke_margins(geometry, rectangle).fits


def require_fit(geometry: RobotGeometry, rectangle: Rectangle) -> StrokeMargins:
    """Margins of a rectangle that lies wholly in the reachable region.

    Raises:
        RectangleOutsideError: it does not; names the limit it exceeds most, and where.
    """
    margins = stroke_margins(geometry, rectangle)
    if not margins.fits:
        worst = margins.smallest
        msg = (
            f"the rectangle of {rectangle.width_mm:g} x {rectangle.height_mm:g} mm about "
            f"({rectangle.center_x_mm:g}, {rectangle.center_y_mm:g}) leaves the workspace: at "
            f"({worst.at.x_mm:.1f}, {worst.at.y_mm:.1f}) it is {-worst.value_mm:.1f} mm beyond "
            f"the limit {worst.limit.value}"
        )
        raise RectangleOutsideError(msg, {"limit": worst.limit.value, "excess_mm": -worst.value_mm})
    return margins


def reach_mm(geometry: RobotGeometry, height_mm: float) -> float:
    """How far a leg reaches along the rail at a height above its carriage; 0 beyond its length."""
    return math.sqrt(max(geometry.leg_length_mm**2 - height_mm * height_mm, 0.0))


def nearest_height(rectangle: Rectangle, y_mm: float) -> float:
    """The height of the rectangle nearest to y [mm]."""
    return min(max(y_mm, rectangle.y_min_mm), rectangle.y_max_mm)


def _farthest(rectangle: Rectangle, y_mm: float) -> float:
    return max(rectangle.y_min_mm, rectangle.y_max_mm, key=lambda edge: abs(edge - y_mm))
