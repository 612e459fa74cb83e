"""The paper's Lame curves beside the square that they stand for."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from twin.geometry import RobotGeometry
from twin.study.plots.style import SQUARE, legend_below, new_figure, wall_axes
from twin.study.plots.workspace import draw_arcs, fill_region, outline
from twin.workspace import (
    LameComparison,
    Rectangle,
    RectangleOutsideError,
    compare_with_lame,
    reachable_region,
)
from twin.workspace.boundary import Array

COLOURS = ("#7b3294", "#009e73")
POINTS = 721


def draw_lame(geometry: RobotGeometry) -> Figure:
    """The figure: on the left curves as large as the square, on the right as large as they claim.

    For a regular box that is no square, the square of its smaller side.
    """
    box = geometry.regular_box
    half_mm = 0.5 * min(box.width_mm, box.height_mm)
    figure = new_figure(96.0)
    left, right = figure.subplots(1, 2)
    wall_axes(left, f"(a) In place of the square of {2 * half_mm:g} mm")
    wall_axes(right, "(b) The largest about its centre")
    for axes in (left, right):
        region = reachable_region(geometry)
        fill_region(axes, region)
        draw_arcs(axes, region, named=False)
    square = Rectangle.square(box.center_x_mm, box.center_y_mm, 2 * half_mm)
    outline(left, square, SQUARE, "square")
    try:
        compared = compare_with_lame(geometry, box.center_x_mm, box.center_y_mm, half_mm)
    except RectangleOutsideError:
        right.text(0.5, 0.5, "The centre is out of reach.", transform=right.transAxes, ha="center")
        compared = ()
    for found, colour in zip(compared, COLOURS, strict=False):
        left.plot(
            *_curve(square, found.exponent, half_mm).T,
            color=colour,
            linewidth=1.3,
            label=f"Lam\u00e9 curve, $n = {found.exponent}$",
            zorder=6,
        )
        claimed_mm = found.largest_curve_half_side_mm
        right.plot(
            *_curve(square, found.exponent, claimed_mm).T, color=colour, linewidth=1.3, zorder=6
        )
        claimed = Rectangle.square(box.center_x_mm, box.center_y_mm, 2 * claimed_mm)
        outline(right, claimed, colour, None, dashes=(2, 2), strength=0.8)
    if compared:
        side_mm = 2 * compared[0].largest_square_half_side_mm
        exact = Rectangle.square(box.center_x_mm, box.center_y_mm, side_mm)
        outline(right, exact, SQUARE, None)
        _say_sides(right, compared)
        room = 0.75 * max(found.largest_curve_half_side_mm for found in compared)
        for axes in (left, right):
            axes.set_xlim(square.x_min_mm - room, square.x_max_mm + room)
            axes.set_ylim(square.y_min_mm - room, square.y_max_mm + room)
    legend_below(figure)
    return figure


def lame_curve(center_x_mm: float, center_y_mm: float, half_side_mm: float, n: int) -> Array:
    """Points of |x - xc|^n + |y - yc|^n = half_side^n, closed, shape (POINTS, 2) [mm]."""
    angle = np.linspace(0.0, 2 * np.pi, POINTS)
    cosine, sine = np.cos(angle), np.sin(angle)
    radius = half_side_mm * (cosine**n + sine**n) ** (-1 / n)
    return np.stack((center_x_mm + radius * cosine, center_y_mm + radius * sine), axis=-1)


def _curve(square: Rectangle, n: int, half_side_mm: float) -> Array:
    return lame_curve(square.center_x_mm, square.center_y_mm, half_side_mm, n)


def _say_sides(axes: Axes, compared: tuple[LameComparison, ...]) -> None:
    lines = [f"square that fits: {2 * compared[0].largest_square_half_side_mm:.1f} mm"]
    lines += [
        f"claimed by $n = {found.exponent}$: {2 * found.largest_curve_half_side_mm:.1f} mm"
        for found in compared
    ]
    axes.text(
        0.5, 0.5, "\n".join(lines), transform=axes.transAxes, ha="center", va="center", fontsize=8.5
    )
