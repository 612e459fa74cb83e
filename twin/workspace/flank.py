"""Curves that bound a region from the left or from the right: x as a function of y.

Every joint limit bounds the platform by such a curve: half a circle of the legs' length, or, for
the edge of a rectangle that slides along the circle's widest point, a vertical line.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from twin.workspace.boundary import Arc, Limit, Piece, Point, Segment


@dataclass(frozen=True, slots=True)
class Flank:
    """x = center.x + side * sqrt(radius^2 - (y - center.y)^2) for y_low <= y <= y_high [mm].

    Attributes:
        center: Centre of the circle; of a vertical line, any of its points.
        radius_mm: Radius of the circle, the same for all flanks of one robot.
        side: 1 for the right half of the circle, -1 for its left half, 0 for a vertical line.
        y_low_mm: Where the flank begins.
        y_high_mm: Where it ends.
        limit: What it is the limit of.
    """

    center: Point
    radius_mm: float
    side: int
    y_low_mm: float
    y_high_mm: float
    limit: Limit

    def covers(self, y_mm: float) -> bool:
        """Whether the flank bounds at this height."""
        return self.y_low_mm <= y_mm <= self.y_high_mm

    def x_at(self, y_mm: float) -> float:
        """Abscissa of the flank at a height [mm]."""
        height = y_mm - self.center.y_mm
        reach = math.sqrt(max(self.radius_mm**2 - height * height, 0.0))
        return self.center.x_mm + self.side * reach

    def is_same_curve(self, other: Flank) -> bool:
        """Whether both are parts of one curve and one limit."""
        return replace(self, y_low_mm=0, y_high_mm=0) == replace(other, y_low_mm=0, y_high_mm=0)

    def piece(self, start_y_mm: float, end_y_mm: float) -> Piece:
        """The part of the flank between two heights, in that direction."""
        start = Point(self.x_at(start_y_mm), start_y_mm)
        end = Point(self.x_at(end_y_mm), end_y_mm)
        if self.side == 0:
            return Segment(start, end, self.limit)
        return Arc(start, end, self.center, self.radius_mm, self.side, self.limit)


def crossing_heights(one: Flank, other: Flank) -> tuple[float, ...]:
    """Heights at which the whole circles or lines of two flanks meet, a superset of the flanks'.

    Touching curves give one height, or two whose distance is the square root of the rounding, or
    none: it makes no difference, because the curves between them are as near as the rounding.
    """
    dx_mm = other.center.x_mm - one.center.x_mm
    dy_mm = other.center.y_mm - one.center.y_mm
    if one.side == 0 and other.side == 0:
        return ()
    if one.side == 0 or other.side == 0:
        circle = other if one.side == 0 else one
        return _symmetric(circle.center.y_mm, one.radius_mm**2 - dx_mm * dx_mm, 1.0)
    distance_sq = dx_mm * dx_mm + dy_mm * dy_mm
    if distance_sq == 0:
        return ()
    middle_y_mm = one.center.y_mm + 0.5 * dy_mm
    return _symmetric(
        middle_y_mm, one.radius_mm**2 - 0.25 * distance_sq, dx_mm / math.sqrt(distance_sq)
    )


def _symmetric(middle: float, square: float, share: float) -> tuple[float, ...]:
    if square < 0:
        return ()
    away = math.sqrt(square) * share
    return (middle - away, middle + away)
