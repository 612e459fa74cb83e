"""The deepest box of tip positions of a given width and height."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from twin.geometry import RobotGeometry
from twin.joints import TipPosition
from twin.kinematics import gamma
from twin.workspace.arc_polygon import ArcPolygon
from twin.workspace.errors import RectangleOutsideError
from twin.workspace.largest import CONTACT_MM, greatest_true, middle_of
from twin.workspace.regions import placement_region
from twin.workspace.tip_space import (
    TipBox,
    TipBoxMargins,
    platform_height_mm,
    tip_box_margins,
)


@dataclass(frozen=True, slots=True)
class DeepestBox:
    """The deepest box of its width and height.

    Attributes:
        box: The box; it fits, and its depth is exact to 1e-9 mm.
        margins: What it leaves.
        limited_by: Names of the limits that it touches.
    """

    box: TipBox
    margins: TipBoxMargins
    limited_by: tuple[str, ...]


def deepest_box_at(geometry: RobotGeometry, box: TipBox) -> DeepestBox:
    """The deepest box with the width, the height and the centre of a given one.

    Raises:
        RectangleOutsideError: not even its middle layer is reached.
    """
    flat = replace(box, depth_mm=0.0)
    margins = tip_box_margins(geometry, flat)
    if not margins.fits:
        msg = (
            f"the tip does not reach all of {box.width_mm:g} x {box.height_mm:g} mm about "
            f"({box.center.x_mm:.1f}, {box.center.y_mm:.1f}, {box.center.z_mm:.1f})"
        )
        raise RectangleOutsideError(msg, {"excess_mm": -margins.smallest_mm})
    depth_mm = greatest_true(
        lambda size_mm: tip_box_margins(geometry, replace(box, depth_mm=size_mm)).fits,
        2 * max(min(margins.rho3_min_mm, margins.rho3_max_mm), 0.0) * math.cos(geometry.theta_rad),
    )
    return _described(geometry, replace(box, depth_mm=depth_mm))


def deepest_box(geometry: RobotGeometry, width_mm: float, height_mm: float) -> DeepestBox:
    """The deepest box of a width and a height that fits anywhere.

    Its centre is the middle of all centres that the box may have.

    Raises:
        InvalidRectangleError: a size is not finite or not greater than zero.
        RectangleOutsideError: no rectangle of this size fits in the wall plane.
    """

    def centers(depth_mm: float) -> ArcPolygon:
        needed_mm = platform_height_mm(geometry, height_mm, depth_mm)
        return placement_region(geometry, width_mm, needed_mm)

    if centers(0.0).is_empty:
        msg = f"a rectangle of {width_mm:g} x {height_mm:g} mm fits nowhere in the workspace"
        raise RectangleOutsideError(msg, {"width_mm": width_mm, "height_mm": height_mm})
    depth_mm = greatest_true(
        lambda size_mm: not centers(size_mm).is_empty,
        geometry.rho3.stroke_mm * math.cos(geometry.theta_rad),
    )
    x_mm, y_mm = middle_of(centers(depth_mm))
    middle_mm = 0.5 * (geometry.rho3.min_mm + geometry.rho3.max_mm)
    rise_mm, out_mm = gamma.tip_offset(geometry, middle_mm)
    center = TipPosition(x_mm, y_mm + rise_mm, out_mm)
    return _described(geometry, TipBox(center, width_mm, height_mm, depth_mm))


def _described(geometry: RobotGeometry, box: TipBox) -> DeepestBox:
    margins = tip_box_margins(geometry, box)
    named = [(margin.limit.value, margin.value_mm) for margin in margins.plane.all]
    named += [("rho3_min", margins.rho3_min_mm), ("rho3_max", margins.rho3_max_mm)]
    return DeepestBox(box, margins, tuple(name for name, left_mm in named if left_mm < CONTACT_MM))
