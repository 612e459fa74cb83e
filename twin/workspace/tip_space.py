"""The space that the plug tip reaches: the slide carries the platform's region out of the wall.

Z depends on rho3 alone, rho3 = (Z + e4z - e3z) / cos(theta), and Y = y + e3y - e4y + rho3
sin(theta). So the slice of the tip's space at a depth Z is the reachable region of V, shifted along
y by an amount that grows with Z as tan(theta): a prism sheared along the insertion axis.

A box of tip positions is inside exactly when the slide reaches both its faces and the platform
reaches a rectangle that is taller than the box by depth * |tan(theta)|.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Self

from twin.geometry import RobotGeometry
from twin.joints import TipPosition
from twin.kinematics import gamma
from twin.workspace.arc_polygon import ArcPolygon
from twin.workspace.margins import FIT_TOLERANCE_MM, StrokeMargins, stroke_margins
from twin.workspace.rectangle import Rectangle, check_sizes
from twin.workspace.regions import reachable_region


@dataclass(frozen=True, slots=True)
class TipBox:
    """All tip positions within a width (x), a height (y) and a depth (z) about a centre [mm].

    Raises:
        InvalidRectangleError: a size is not finite or not greater than zero; depth may be 0.
    """

    center: TipPosition
    width_mm: float
    height_mm: float
    depth_mm: float

    def __post_init__(self) -> None:
        check_sizes(self.width_mm, self.height_mm)
        if self.depth_mm != 0:
            check_sizes(self.width_mm, self.depth_mm)

    @classmethod
    def regular(cls, geometry: RobotGeometry) -> Self:
        """The box that configuration asks for: V at its centre with the slide in mid-stroke."""
        box, travel = geometry.regular_box, geometry.rho3
        rise_mm, out_mm = gamma.tip_offset(geometry, 0.5 * (travel.min_mm + travel.max_mm))
        center = TipPosition(box.center_x_mm, box.center_y_mm + rise_mm, out_mm)
        return cls(center, box.width_mm, box.height_mm, box.depth_mm)


@dataclass(frozen=True, slots=True)
class TipBoxMargins:
    """What a box of tip positions leaves.

    Attributes:
        platform: All positions of V that the box needs.
        plane: Margins of those.
        rho3_min_mm: Stroke left before rho3 is at its start, at the face nearest the wall.
        rho3_max_mm: Stroke left before rho3 is at its end, at the face nearest the car.
    """

    platform: Rectangle
    plane: StrokeMargins
    rho3_min_mm: float
    rho3_max_mm: float

    @property
    def smallest_mm(self) -> float:
        """The least of all margins; negative if the box is not inside."""
        return min(self.plane.smallest.value_mm, self.rho3_min_mm, self.rho3_max_mm)

    @property
    def fits(self) -> bool:
        """Whether all positions of the box are reached."""
        return self.smallest_mm >= -FIT_TOLERANCE_MM


def tip_depth_range(geometry: RobotGeometry) -> tuple[float, float]:
    """Least and greatest Z of the tip [mm]."""
    least_mm = gamma.tip_offset(geometry, geometry.rho3.min_mm)[1]
    greatest_mm = gamma.tip_offset(geometry, geometry.rho3.max_mm)[1]
    return least_mm, greatest_mm


def tip_slice(geometry: RobotGeometry, z_mm: float) -> ArcPolygon:
    """All (X, Y) that the tip reaches at a depth Z; empty beyond the slide's travel.

    Raises:
        EmptyWorkspaceError: the robot reaches no position at all.
    """
    rho3_mm = _rho3(geometry, z_mm)
    if abs(geometry.rho3.excess_mm(rho3_mm)) > FIT_TOLERANCE_MM:
        return ArcPolygon(())
    return reachable_region(geometry).translated(0.0, gamma.tip_offset(geometry, rho3_mm)[0])


def tip_volume_mm3(geometry: RobotGeometry) -> float:
    """Volume of the tip's space [mm^3]: shearing keeps it, so it is area times depth."""
    least_mm, greatest_mm = tip_depth_range(geometry)
    return reachable_region(geometry).area_mm2 * (greatest_mm - least_mm)


def tip_box_margins(geometry: RobotGeometry, box: TipBox) -> TipBoxMargins:
    """Margins of a whole box of tip positions, exact."""
    middle_mm = _rho3(geometry, box.center.z_mm)
    half_slide_mm = 0.5 * box.depth_mm / math.cos(geometry.theta_rad)
    rise_mm = gamma.tip_offset(geometry, middle_mm)[0]
    platform = Rectangle(
        box.center.x_mm,
        box.center.y_mm - rise_mm,
        box.width_mm,
        platform_height_mm(geometry, box.height_mm, box.depth_mm),
    )
    return TipBoxMargins(
        platform,
        stroke_margins(geometry, platform),
        middle_mm - half_slide_mm - geometry.rho3.min_mm,
        geometry.rho3.max_mm - middle_mm - half_slide_mm,
    )


def platform_height_mm(geometry: RobotGeometry, height_mm: float, depth_mm: float) -> float:
    """Height of the rectangle of V that a box of tip positions needs [mm]."""
    return height_mm + depth_mm * abs(math.tan(geometry.theta_rad))


def _rho3(geometry: RobotGeometry, z_mm: float) -> float:
    return (z_mm + geometry.e4z_mm - geometry.e3z_mm) / math.cos(geometry.theta_rad)
