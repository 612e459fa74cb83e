"""The paper's own question: for which offsets and strokes is the regular square inside?

Let the carriages run at one height e_y, let the rectangle of V reach from x0 to x1 and from y0 to
y1, and let M and m be the greatest and the least reach sqrt(L^2 - (y - e_y)^2) of a leg over its
heights. Then it is inside exactly when (strokes starting at 0)

    e1x      <= x0 - L3/2 - M,              e1x + s1 >= x1 - L3/2 - m,
    e2x      <= L2 - x1 - L3/2 - M,         e2x + s2 >= L2 - x0 - L3/2 - m,
    y1 - L   <= e_y <= y0.

So each stroke is at least x1 - x0 + M - m, wherever the rail stands.

The centre of the paper's square, x_c = 570, equals L2/2 - L3/2: for a symmetric robot that is the
abscissa of B, and V stands at 650, in the middle of the rail. Read as the abscissa of V it asks for
e1x - e2x = -160 = -L3.

The paper writes its conditions as four discs: all corners within L of (e5x, e1y) and (e6x, e2y),
and the centres (e1x, e1y) and (e7x, e2y) at least L away, each shifted by the half platform. Its
text gives e6x and e7x the same definition; e6x belongs to the end of the right stroke and e7x to
its start. It announces a fifth condition and does not print it: the side of the assembly mode. Its
inverse kinematics prints sqrt(2 L^2 - ...), which contradicts its own constraints.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from twin.geometry import RobotGeometry
from twin.workspace.boundary import Point
from twin.workspace.errors import RectangleOutsideError
from twin.workspace.leg_flanks import foot_abscissae, leg_band
from twin.workspace.margins import FIT_TOLERANCE_MM, nearest_height, reach_mm
from twin.workspace.rectangle import Rectangle


@dataclass(frozen=True, slots=True)
class OffsetConditions:
    """For one height of the carriages: all offsets and strokes that keep a rectangle inside.

    Attributes:
        e_y_mm: Height of both carriages, e1y = e2y.
        e_y_min_mm: Least height of the carriages that any offsets make up for.
        e_y_max_mm: Greatest such height.
        e1x_max_mm: e1x <= this.
        e1x_plus_s1_min_mm: e1x + s1 >= this.
        e2x_max_mm: e2x <= this.
        e2x_plus_s2_min_mm: e2x + s2 >= this.
    """

    e_y_mm: float
    e_y_min_mm: float
    e_y_max_mm: float
    e1x_max_mm: float
    e1x_plus_s1_min_mm: float
    e2x_max_mm: float
    e2x_plus_s2_min_mm: float

    @property
    def s1_min_mm(self) -> float:
        """Least stroke of the left carriage [mm]; s2 needs the same."""
        return self.e1x_plus_s1_min_mm - self.e1x_max_mm

    @property
    def s2_min_mm(self) -> float:
        """Least stroke of the right carriage [mm]."""
        return self.e2x_plus_s2_min_mm - self.e2x_max_mm

    def permits(self, *, e1x_mm: float, s1_mm: float, e2x_mm: float, s2_mm: float) -> bool:
        """Whether the rectangle is inside for these offsets and strokes."""
        return (
            e1x_mm <= self.e1x_max_mm + FIT_TOLERANCE_MM
            and e1x_mm + s1_mm >= self.e1x_plus_s1_min_mm - FIT_TOLERANCE_MM
            and e2x_mm <= self.e2x_max_mm + FIT_TOLERANCE_MM
            and e2x_mm + s2_mm >= self.e2x_plus_s2_min_mm - FIT_TOLERANCE_MM
        )

    def sentences(self) -> tuple[str, ...]:
        """The conditions in words, one per line [mm]."""
        return (
            f"{self.e_y_min_mm:.2f} <= e1y = e2y = {self.e_y_mm:g} <= {self.e_y_max_mm:.2f}",
            f"e1x <= {self.e1x_max_mm:.2f}",
            f"e1x + s1 >= {self.e1x_plus_s1_min_mm:.2f}",
            f"e2x <= {self.e2x_max_mm:.2f}",
            f"e2x + s2 >= {self.e2x_plus_s2_min_mm:.2f}",
            f"so s1 >= {self.s1_min_mm:.2f} and s2 >= {self.s2_min_mm:.2f}",
        )


def offset_conditions(
    geometry: RobotGeometry, rectangle: Rectangle, e_y_mm: float
) -> OffsetConditions:
    """The exact conditions on e1x, e2x, s1 and s2 for carriages at one height.

    Only L, L2 and L3 are taken from the geometry; strokes start at 0.

    Raises:
        RectangleOutsideError: no offsets and strokes make up for this height of the carriages.
    """
    e_y_min_mm = rectangle.y_max_mm - geometry.leg_length_mm
    if not e_y_min_mm <= e_y_mm <= rectangle.y_min_mm:
        msg = (
            f"with carriages at {e_y_mm:g} mm the legs serve no rectangle from "
            f"{rectangle.y_min_mm:g} to {rectangle.y_max_mm:g} mm; their height must be between "
            f"{e_y_min_mm:g} and {rectangle.y_min_mm:g} mm"
        )
        raise RectangleOutsideError(msg, {"e_y_mm": e_y_mm})
    half_mm = 0.5 * geometry.platform_width_mm
    greatest_mm = reach_mm(geometry, rectangle.y_min_mm - e_y_mm)
    least_mm = reach_mm(geometry, rectangle.y_max_mm - e_y_mm)
    right_mm = geometry.base_width_mm - half_mm
    return OffsetConditions(
        e_y_mm=e_y_mm,
        e_y_min_mm=e_y_min_mm,
        e_y_max_mm=rectangle.y_min_mm,
        e1x_max_mm=rectangle.x_min_mm - half_mm - greatest_mm,
        e1x_plus_s1_min_mm=rectangle.x_max_mm - half_mm - least_mm,
        e2x_max_mm=right_mm - rectangle.x_max_mm - greatest_mm,
        e2x_plus_s2_min_mm=right_mm - rectangle.x_min_mm - least_mm,
    )


def v_abscissa_of_b(geometry: RobotGeometry, b_x_mm: float) -> float:
    """Abscissa of V when B stands at a given one [mm]: 570 is 650 for the paper's platform."""
    return b_x_mm + 0.5 * geometry.platform_width_mm


@dataclass(frozen=True, slots=True)
class PaperDiscs:
    """The paper's four disc conditions and the side it leaves out, as distances left [mm].

    Negative distances say "outside". With strokes over about 560 mm the first two discs exclude
    rectangles that the robot reaches; `twin.workspace.margins` is exact for all strokes.

    Attributes:
        within_left_end_mm: L minus the distance of the farthest corner from (e5x, e1y).
        within_right_end_mm: L minus the distance of the farthest corner from (e6x, e2y).
        beyond_left_start_mm: Distance of the rectangle from (e1x, e1y), minus L.
        beyond_right_start_mm: Distance of the rectangle from (e7x, e2y), minus L.
        above_carriages_mm: The condition that is not printed: height above the flat legs.
    """

    within_left_end_mm: float
    within_right_end_mm: float
    beyond_left_start_mm: float
    beyond_right_start_mm: float
    above_carriages_mm: float

    @property
    def all_hold(self) -> bool:
        """Whether the rectangle is inside by these conditions."""
        least_mm = min(
            self.within_left_end_mm,
            self.within_right_end_mm,
            self.beyond_left_start_mm,
            self.beyond_right_start_mm,
            self.above_carriages_mm,
        )
        return least_mm >= -FIT_TOLERANCE_MM


def paper_discs(geometry: RobotGeometry, rectangle: Rectangle) -> PaperDiscs:
    """The paper's conditions for a rectangle, to be compared with the exact margins."""
    a, b = foot_abscissae(geometry)
    length_mm = geometry.leg_length_mm

    def within(center: Point) -> float:
        return length_mm - max(math.dist(corner, center) for corner in rectangle.corners)

    def beyond(center: Point) -> float:
        x_mm = min(max(center.x_mm, rectangle.x_min_mm), rectangle.x_max_mm)
        nearest = Point(x_mm, nearest_height(rectangle, center.y_mm))
        return math.dist(nearest, center) - length_mm

    return PaperDiscs(
        within(Point(a + geometry.rho1.max_mm, geometry.e1y_mm)),
        within(Point(b - geometry.rho2.max_mm, geometry.e2y_mm)),
        beyond(Point(a + geometry.rho1.min_mm, geometry.e1y_mm)),
        beyond(Point(b - geometry.rho2.min_mm, geometry.e2y_mm)),
        rectangle.y_min_mm - leg_band(geometry).y_low_mm,
    )
