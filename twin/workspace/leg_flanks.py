"""The flanks and bands that the robot's legs and joint limits give the platform.

With d1(y) = sqrt(L^2 - (y - e1y)^2) and d2(y) = sqrt(L^2 - (y - e2y)^2) the inverse kinematics
reads rho1 = x - a - d1 and rho2 = b - x - d2, where a = e1x + L3/2 and b = L2 - e2x - L3/2. So the
travels of the carriages are, in the robot's own working mode,

    a + rho1_min + d1(y) <= x <= a + rho1_max + d1(y),
    b - rho2_max - d2(y) <= x <= b - rho2_min - d2(y).

The paper bounds the same set by four discs and announces a fifth condition that it does not print
(the side of the assembly mode); it also gives the right carriage at the start and at the end of
its stroke the same abscissa. A disc bounds the leaning of a leg that is not used as well, so with
long strokes (from about 560 mm on) the four discs exclude positions that the robot reaches: these
flanks are the halves of their circles that really bound.

The side of the assembly mode, d1 h2 + d2 h1 >= 0, holds exactly from y = (e1y + e2y) / 2 on,
because with h = L sin(phi) it says sin(phi1 + phi2) >= 0. Where one carriage is higher than the
other, the platform may thus dive a little below the higher one.

A rectangle lies inside when its worst points do. For its centre that is the same set with flanks
moved inwards: the rectangle stays outside a circle as long as its nearest point does (a circle
rolled around a rectangle: two arcs and a vertical line), and inside a circle as long as its two
farthest corners do (two arcs).
"""

from __future__ import annotations

from functools import partial
from typing import NamedTuple

from twin.geometry import RobotGeometry
from twin.workspace.between import Band
from twin.workspace.boundary import Limit, Point
from twin.workspace.flank import Flank


class Flanks(NamedTuple):
    """What bounds the centre of a rectangle from the left and from the right."""

    left: tuple[Flank, ...]
    right: tuple[Flank, ...]


def foot_abscissae(geometry: RobotGeometry) -> tuple[float, float]:
    """(a, b) [mm]: rho1 = x - a - d1 and rho2 = b - x - d2."""
    half_mm = 0.5 * geometry.platform_width_mm
    return geometry.e1x_mm + half_mm, geometry.base_width_mm - geometry.e2x_mm - half_mm


def leg_band(geometry: RobotGeometry) -> Band:
    """Heights of V on the assembly side that both legs reach; low exceeds high if none is."""
    middle_mm = 0.5 * (geometry.e1y_mm + geometry.e2y_mm)
    full_rise_mm = min(geometry.e1y_mm, geometry.e2y_mm) + geometry.leg_length_mm
    return Band(middle_mm, full_rise_mm, Limit.ASSEMBLY_SIDE, Limit.LEG_LENGTH)


def leg_flanks(
    geometry: RobotGeometry, half_width_mm: float = 0.0, half_height_mm: float = 0.0
) -> Flanks:
    """Flanks for the centre of a rectangle of V positions; of a point by default."""
    a, b = foot_abscissae(geometry)
    rho1, rho2 = geometry.rho1, geometry.rho2
    outside = partial(_outside, geometry.leg_length_mm, half_height_mm)
    inside = partial(_inside, geometry.leg_length_mm, half_height_mm)
    return Flanks(
        left=(
            *outside(Point(a + rho1.min_mm + half_width_mm, geometry.e1y_mm), 1, Limit.RHO1_MIN),
            *inside(Point(b - rho2.max_mm + half_width_mm, geometry.e2y_mm), -1, Limit.RHO2_MAX),
        ),
        right=(
            *inside(Point(a + rho1.max_mm - half_width_mm, geometry.e1y_mm), 1, Limit.RHO1_MAX),
            *outside(Point(b - rho2.min_mm - half_width_mm, geometry.e2y_mm), -1, Limit.RHO2_MIN),
        ),
    )


def _outside(
    radius_mm: float, half_height_mm: float, center: Point, side: int, limit: Limit
) -> tuple[Flank, ...]:
    """Where the nearest edge or corner of the rectangle touches the circle from outside."""
    x_mm, y_mm = center
    low_mm, high_mm = y_mm - half_height_mm, y_mm + half_height_mm
    below = Flank(Point(x_mm, low_mm), radius_mm, side, low_mm - radius_mm, low_mm, limit)
    beside = Flank(Point(x_mm + side * radius_mm, y_mm), radius_mm, 0, low_mm, high_mm, limit)
    above = Flank(Point(x_mm, high_mm), radius_mm, side, high_mm, high_mm + radius_mm, limit)
    return (below, beside, above) if half_height_mm > 0 else (below, above)


def _inside(
    radius_mm: float, half_height_mm: float, center: Point, side: int, limit: Limit
) -> tuple[Flank, ...]:
    """Where the upper and the lower far corner of the rectangle touch the circle from inside."""
    x_mm, y_mm = center
    heights = {y_mm - half_height_mm, y_mm + half_height_mm}
    return tuple(
        Flank(Point(x_mm, y), radius_mm, side, y - radius_mm, y + radius_mm, limit)
        for y in sorted(heights)
    )
