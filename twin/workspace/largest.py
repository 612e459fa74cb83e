"""The largest rectangle of a given shape, and where it sits.

A rectangle contains every smaller one of the same centre and shape, so "a rectangle of this size
fits somewhere" is true up to the largest size and false beyond it. Bisection on the size, with the
exact placement region to decide, therefore converges to the largest one for certain.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from twin.geometry import RobotGeometry
from twin.workspace.arc_polygon import ArcPolygon
from twin.workspace.boundary import Limit
from twin.workspace.errors import InvalidRectangleError, RectangleOutsideError
from twin.workspace.margins import StrokeMargins, fits, stroke_margins
from twin.workspace.rectangle import Rectangle
from twin.workspace.regions import placement_region, reachable_region

TOLERANCE_MM = 1e-9
"""The height found is less than the true largest one by at most this."""

CONTACT_MM = 1e-6
"""A margin below this counts as a contact."""


@dataclass(frozen=True, slots=True)
class LargestRectangle:
    """The largest rectangle of its shape.

    Attributes:
        rectangle: The rectangle; it fits.
        margins: What it leaves.
        contacts: The limits that it touches.
        free_x_mm: How far it can still be shifted along x; below 1e-3 its place is unique.
        free_y_mm: How far it can still be shifted along y.
    """

    rectangle: Rectangle
    margins: StrokeMargins
    contacts: tuple[Limit, ...]
    free_x_mm: float
    free_y_mm: float


def largest_rectangle(geometry: RobotGeometry, aspect: float = 1.0) -> LargestRectangle:
    """The largest rectangle that fits anywhere.

    Its size is exact to TOLERANCE_MM, its place to about the square root of L times that where
    it sits in a round corner. Where it can be shifted, it stands in the middle of its freedom.

    Args:
        geometry: The robot.
        aspect: Width / height.

    Raises:
        InvalidRectangleError: the aspect is not a finite number greater than zero.
        EmptyWorkspaceError: the robot reaches no position.
    """
    _check_aspect(aspect)
    extent = reachable_region(geometry).extent
    upper_mm = min(extent.y_max_mm - extent.y_min_mm, (extent.x_max_mm - extent.x_min_mm) / aspect)
    height_mm = greatest_true(
        lambda size_mm: not placement_region(geometry, aspect * size_mm, size_mm).is_empty,
        upper_mm,
    )
    centers = placement_region(geometry, aspect * height_mm, height_mm)
    x_mm, y_mm = middle_of(centers)
    free = centers.extent
    return _described(
        geometry,
        Rectangle(x_mm, y_mm, aspect * height_mm, height_mm),
        free.x_max_mm - free.x_min_mm,
        free.y_max_mm - free.y_min_mm,
    )


def largest_rectangle_at(
    geometry: RobotGeometry, center_x_mm: float, center_y_mm: float, aspect: float = 1.0
) -> LargestRectangle:
    """The largest rectangle about a given centre, its height exact to TOLERANCE_MM.

    Raises:
        InvalidRectangleError: the aspect is not a finite number greater than zero.
        RectangleOutsideError: the centre itself is not inside the workspace.
        EmptyWorkspaceError: the robot reaches no position.
    """
    _check_aspect(aspect)
    extent = reachable_region(geometry).extent

    def about_centre(height_mm: float) -> Rectangle:
        return Rectangle(center_x_mm, center_y_mm, aspect * height_mm, height_mm)

    height_mm = greatest_true(
        lambda size_mm: fits(geometry, about_centre(size_mm)), extent.y_max_mm - extent.y_min_mm
    )
    if height_mm == 0:
        msg = f"({center_x_mm:g}, {center_y_mm:g}) is not inside the workspace"
        raise RectangleOutsideError(msg, {"x_mm": center_x_mm, "y_mm": center_y_mm})
    return _described(geometry, about_centre(height_mm), 0.0, 0.0)


def greatest_true(holds: Callable[[float], bool], upper_mm: float) -> float:
    """The greatest length up to a bound for which a condition that holds below it still holds.

    Returns:
        A length for which it holds, at most TOLERANCE_MM below the greatest; 0 if it never does.
    """
    if holds(upper_mm):
        return upper_mm
    low_mm, high_mm = 0.0, upper_mm
    while high_mm - low_mm > TOLERANCE_MM:
        middle_mm = 0.5 * (low_mm + high_mm)
        if holds(middle_mm):
            low_mm = middle_mm
        else:
            high_mm = middle_mm
    return low_mm


def middle_of(region: ArcPolygon) -> tuple[float, float]:
    """A point of a region that every horizontal line cuts once: the middle of its middle chord.

    Raises:
        EmptyRegionError: the region has no points.
    """
    extent = region.extent
    y_mm = 0.5 * (extent.y_min_mm + extent.y_max_mm)
    chord = region.chord(y_mm) or (extent.x_min_mm, extent.x_max_mm)
    return 0.5 * (chord[0] + chord[1]), y_mm


def _described(
    geometry: RobotGeometry, rectangle: Rectangle, free_x_mm: float, free_y_mm: float
) -> LargestRectangle:
    margins = stroke_margins(geometry, rectangle)
    contacts = tuple(margin.limit for margin in margins.all if margin.value_mm < CONTACT_MM)
    return LargestRectangle(rectangle, margins, contacts, free_x_mm, free_y_mm)


def _check_aspect(aspect: float) -> None:
    if not (math.isfinite(aspect) and aspect > 0):
        msg = f"a rectangle cannot have a width of {aspect:g} times its height"
        raise InvalidRectangleError(msg, {"aspect": aspect})
