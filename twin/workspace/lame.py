"""The paper's smooth stand-in for a square, |x - xc|^n + |y - yc|^n = lb^n, beside the square.

For its cylindrical algebraic decomposition the paper replaces the square by this Lame curve, with
n = 6 and then 12. There lb is the half side, though its text calls it the side. The curve lies
inside the square and cuts its corners, which are just what limits the square: at a corner it
stays lb (1 - 2^(-1/n)) short in x and in y, 11 % of lb for n = 6 and 6 % for n = 12. It therefore
finds more room than there is.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from twin.geometry import RobotGeometry
from twin.workspace.boundary import Array, Limit, Point
from twin.workspace.errors import InvalidRectangleError
from twin.workspace.interval import least_on
from twin.workspace.largest import greatest_true, largest_rectangle_at
from twin.workspace.leg_flanks import foot_abscissae, leg_band
from twin.workspace.margins import Margin, StrokeMargins, stroke_margins
from twin.workspace.rectangle import Rectangle

PAPER_EXPONENTS = (6, 12)


@dataclass(frozen=True, slots=True)
class LameComparison:
    """A Lame curve and the square it stands for, about one centre.

    Attributes:
        exponent: n.
        curve: Margins of all positions that the curve encloses.
        square: Margins of the square.
        largest_curve_half_side_mm: Greatest lb whose curve fits about the centre.
        largest_square_half_side_mm: Greatest half side of a square that fits there.
    """

    exponent: int
    curve: StrokeMargins
    square: StrokeMargins
    largest_curve_half_side_mm: float
    largest_square_half_side_mm: float

    @property
    def hidden_stroke_mm(self) -> dict[Limit, float]:
        """How much more stroke the square needs than its curve says, by limit [mm]."""
        pairs = zip(self.curve.all, self.square.all, strict=True)
        return {curve.limit: curve.value_mm - square.value_mm for curve, square in pairs}

    @property
    def overstated_half_side_mm(self) -> float:
        """By how much the curve overstates the half side that fits [mm]."""
        return self.largest_curve_half_side_mm - self.largest_square_half_side_mm


def compare_with_lame(
    geometry: RobotGeometry,
    center_x_mm: float,
    center_y_mm: float,
    half_side_mm: float,
    exponents: tuple[int, ...] = PAPER_EXPONENTS,
) -> tuple[LameComparison, ...]:
    """The paper's approximation beside the exact answer, one comparison per exponent.

    Raises:
        InvalidRectangleError: the half side makes no square, or an exponent is not even and >= 2.
        RectangleOutsideError: the centre itself is not inside the workspace.
    """
    square = Rectangle.square(center_x_mm, center_y_mm, 2 * half_side_mm)
    exact = stroke_margins(geometry, square)
    largest = largest_rectangle_at(geometry, center_x_mm, center_y_mm).rectangle
    compared = []
    for exponent in exponents:

        def about_centre(size_mm: float, n: int = exponent) -> StrokeMargins:
            return lame_margins(geometry, center_x_mm, center_y_mm, size_mm, n)

        compared.append(
            LameComparison(
                exponent,
                about_centre(half_side_mm),
                exact,
                greatest_true(lambda size_mm: about_centre(size_mm).fits, largest.height_mm),
                0.5 * largest.height_mm,
            )
        )
    return tuple(compared)


def lame_margins(
    geometry: RobotGeometry,
    center_x_mm: float,
    center_y_mm: float,
    half_side_mm: float,
    exponent: int,
) -> StrokeMargins:
    """Margins of all positions that a Lame curve encloses.

    rho1 and rho2 change by 1 mm per mm along x everywhere, so their extremes are on the curve,
    where they are found by sampling its angle and zooming in.

    Raises:
        InvalidRectangleError: the half side makes no curve, or the exponent is not even and >= 2.
    """
    Rectangle.square(center_x_mm, center_y_mm, 2 * half_side_mm)
    if exponent < 2 or exponent % 2:
        msg = f"a Lame curve with the exponent {exponent} is not this smooth square"
        raise InvalidRectangleError(msg, {"exponent": exponent})
    a, b = foot_abscissae(geometry)
    low_mm, high_mm = leg_band(geometry)[:2]
    bottom = Point(center_x_mm, center_y_mm - half_side_mm)
    top = Point(center_x_mm, center_y_mm + half_side_mm)

    def curve(angle_rad: Array) -> tuple[Array, Array]:
        cosine, sine = np.cos(angle_rad), np.sin(angle_rad)
        radius = half_side_mm * (cosine**exponent + sine**exponent) ** (-1 / exponent)
        return center_x_mm + radius * cosine, center_y_mm + radius * sine

    def rho1(angle_rad: Array) -> Array:
        x, y = curve(angle_rad)
        return x - a - _reach(geometry, y - geometry.e1y_mm)

    def rho2(angle_rad: Array) -> Array:
        x, y = curve(angle_rad)
        return b - x - _reach(geometry, y - geometry.e2y_mm)

    def margin(left: Callable[[Array], Array], limit: Limit) -> Margin:
        angle_rad, value_mm = least_on(left, -math.pi, math.pi)
        x, y = curve(np.array(angle_rad))
        return Margin(value_mm, Point(float(x), float(y)), limit)

    return StrokeMargins(
        margin(lambda angle: rho1(angle) - geometry.rho1.min_mm, Limit.RHO1_MIN),
        margin(lambda angle: geometry.rho1.max_mm - rho1(angle), Limit.RHO1_MAX),
        margin(lambda angle: rho2(angle) - geometry.rho2.min_mm, Limit.RHO2_MIN),
        margin(lambda angle: geometry.rho2.max_mm - rho2(angle), Limit.RHO2_MAX),
        Margin(bottom.y_mm - low_mm, bottom, Limit.ASSEMBLY_SIDE),
        Margin(high_mm - top.y_mm, top, Limit.LEG_LENGTH),
    )


def _reach(geometry: RobotGeometry, height_mm: Array) -> Array:
    reach: Array = np.sqrt(np.maximum(geometry.leg_length_mm**2 - height_mm**2, 0.0))
    return reach
