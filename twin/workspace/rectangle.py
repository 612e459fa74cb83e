"""Axis-parallel rectangles of positions of V."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Self

from twin.geometry import RegularBox
from twin.workspace.boundary import Point
from twin.workspace.errors import InvalidRectangleError


@dataclass(frozen=True, slots=True)
class Rectangle:
    """All positions of V within a width and a height about a centre [mm].

    Raises:
        InvalidRectangleError: a number is not finite, or a size is not greater than zero.
    """

    center_x_mm: float
    center_y_mm: float
    width_mm: float
    height_mm: float

    def __post_init__(self) -> None:
        check_sizes(self.width_mm, self.height_mm)
        if not (math.isfinite(self.center_x_mm) and math.isfinite(self.center_y_mm)):
            msg = f"({self.center_x_mm}, {self.center_y_mm}) is no centre of a rectangle"
            raise InvalidRectangleError(msg)

    @classmethod
    def square(cls, center_x_mm: float, center_y_mm: float, side_mm: float) -> Self:
        """The square of a given side."""
        return cls(center_x_mm, center_y_mm, side_mm, side_mm)

    @classmethod
    def of_box(cls, box: RegularBox) -> Self:
        """The face of the box of targets that configuration asks for."""
        return cls(box.center_x_mm, box.center_y_mm, box.width_mm, box.height_mm)

    @property
    def x_min_mm(self) -> float:
        """Left edge [mm]."""
        return self.center_x_mm - 0.5 * self.width_mm

    @property
    def x_max_mm(self) -> float:
        """Right edge [mm]."""
        return self.center_x_mm + 0.5 * self.width_mm

    @property
    def y_min_mm(self) -> float:
        """Lower edge [mm]."""
        return self.center_y_mm - 0.5 * self.height_mm

    @property
    def y_max_mm(self) -> float:
        """Upper edge [mm]."""
        return self.center_y_mm + 0.5 * self.height_mm

    @property
    def corners(self) -> tuple[Point, Point, Point, Point]:
        """Lower left, lower right, upper right, upper left."""
        return (
            Point(self.x_min_mm, self.y_min_mm),
            Point(self.x_max_mm, self.y_min_mm),
            Point(self.x_max_mm, self.y_max_mm),
            Point(self.x_min_mm, self.y_max_mm),
        )


def check_sizes(width_mm: float, height_mm: float) -> None:
    """Do nothing if a rectangle can have these sizes.

    Raises:
        InvalidRectangleError: a size is not finite or not greater than zero.
    """
    for name, size_mm in (("width", width_mm), ("height", height_mm)):
        if not (math.isfinite(size_mm) and size_mm > 0):
            msg = f"a rectangle cannot have a {name} of {size_mm:g} mm"
            raise InvalidRectangleError(msg, {f"{name}_mm": size_mm})
