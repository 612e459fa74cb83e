"""The pieces that bound a region of the plane: circular arcs and straight segments.

A region lies on the left of its pieces: they run counterclockwise about it. Every piece is
monotone in y, because each arc keeps to the left or the right half of its circle.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Limit(StrEnum):
    """What ends a region of positions there."""

    RHO1_MIN = "rho1_min"
    RHO1_MAX = "rho1_max"
    RHO2_MIN = "rho2_min"
    RHO2_MAX = "rho2_max"
    ASSEMBLY_SIDE = "assembly_side"
    LEG_LENGTH = "leg_length"
    PARALLEL = "parallel"
    SERIAL = "serial"
    PARALLELOGRAM = "parallelogram"


class Point(NamedTuple):
    """A position in the wall plane of the base frame [mm]."""

    x_mm: float
    y_mm: float


@dataclass(frozen=True, slots=True)
class Segment:
    """A straight piece from start to end."""

    start: Point
    end: Point
    limit: Limit

    @property
    def length_mm(self) -> float:
        """Length of the piece [mm]."""
        return math.dist(self.start, self.end)

    @property
    def twice_area_mm2(self) -> float:
        """The piece's share of the line integral of x dy - y dx, twice the area [mm^2]."""
        return self.start.x_mm * self.end.y_mm - self.end.x_mm * self.start.y_mm

    def x_at(self, y_mm: Array) -> Array:
        """Abscissae at heights of the piece [mm]; it must not be horizontal."""
        (x0, y0), (x1, y1) = self.start, self.end
        return x0 + (y_mm - y0) * ((x1 - x0) / (y1 - y0))

    def points(self, count: int) -> Array:
        """Points along the piece with both ends, shape (count, 2) [mm]."""
        return np.linspace(self.start, self.end, count)

    def translated(self, dx_mm: float, dy_mm: float) -> Segment:
        """The same piece elsewhere."""
        return Segment(_moved(self.start, dx_mm, dy_mm), _moved(self.end, dx_mm, dy_mm), self.limit)


@dataclass(frozen=True, slots=True)
class Arc:
    """An arc of a circle from start to end, on one half of the circle.

    Attributes:
        start: First point. Neighbours share the y of their common vertex to the last bit.
        end: Last point.
        center: Centre of the circle.
        radius_mm: Its radius.
        side: 1 on the right half of the circle, -1 on its left half.
        limit: What the arc is the limit of.
    """

    start: Point
    end: Point
    center: Point
    radius_mm: float
    side: int
    limit: Limit

    @property
    def start_rad(self) -> float:
        """Angle of the first point about the centre, from the x axis."""
        return self._angle(self.start)

    @property
    def end_rad(self) -> float:
        """Angle of the last point; greater than start_rad where the arc runs counterclockwise."""
        return self._angle(self.end)

    @property
    def length_mm(self) -> float:
        """Length of the piece [mm]."""
        return self.radius_mm * abs(self.end_rad - self.start_rad)

    @property
    def twice_area_mm2(self) -> float:
        """The piece's share of the line integral of x dy - y dx, twice the area [mm^2].

        With x = cx + r cos t and y = cy + r sin t the integrand is r^2 dt + cx dy - cy dx.
        """
        (x0, y0), (x1, y1) = self.start, self.end
        sector = self.radius_mm**2 * (self.end_rad - self.start_rad)
        return sector + self.center.x_mm * (y1 - y0) - self.center.y_mm * (x1 - x0)

    def x_at(self, y_mm: Array) -> Array:
        """Abscissae at heights of the piece [mm]."""
        height = y_mm - self.center.y_mm
        reach = np.sqrt(np.maximum(self.radius_mm**2 - height * height, 0.0))
        return np.asarray(self.center.x_mm + self.side * reach)

    def points(self, count: int) -> Array:
        """Points along the piece with both ends, shape (count, 2) [mm]."""
        angle = np.linspace(self.start_rad, self.end_rad, count)
        points = self.center + self.radius_mm * np.column_stack((np.cos(angle), np.sin(angle)))
        points[0], points[-1] = self.start, self.end
        return points

    def translated(self, dx_mm: float, dy_mm: float) -> Arc:
        """The same piece elsewhere."""
        start, end, center = (_moved(p, dx_mm, dy_mm) for p in (self.start, self.end, self.center))
        return Arc(start, end, center, self.radius_mm, self.side, self.limit)

    def _angle(self, point: Point) -> float:
        """Angle of a point, without a jump inside the arc's half of the circle."""
        away, height = point.x_mm - self.center.x_mm, point.y_mm - self.center.y_mm
        angle = math.atan2(height, self.side * away)
        return angle if self.side > 0 else math.pi - angle


Piece = Arc | Segment
Loop = tuple[Piece, ...]
"""A closed chain of pieces, counterclockwise: each starts where the one before it ends."""


def _moved(point: Point, dx_mm: float, dy_mm: float) -> Point:
    return Point(point.x_mm + dx_mm, point.y_mm + dy_mm)
