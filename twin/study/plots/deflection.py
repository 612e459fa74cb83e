"""Displacement under self-weight: the nine points of alpha and the curve of beta."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from twin.geometry import RobotGeometry
from twin.statics import SagTables
from twin.study.plots.style import HALO, INK, LIMIT_COLOURS, SQUARE, new_figure, wall_axes
from twin.study.plots.workspace import draw_arcs, fill_region, outline
from twin.workspace import Limit, Rectangle, reachable_region

ROOM_MM = 60.0
"""Around the nine points."""


def draw_deflection(geometry: RobotGeometry, tables: SagTables | None = None) -> Figure:
    """The figure. Its title says so when the tables are those of another robot."""
    tables = tables or SagTables()
    figure = new_figure(84.0)
    left, right = figure.subplots(1, 2, width_ratios=(1.34, 1.0))
    _nine_points(figure, left, geometry, tables)
    _slide(right, geometry, tables)
    if not tables.are_of(geometry):
        figure.suptitle(
            f"Computed for another robot: L = {tables.leg_length_mm:g}, "
            f"L2 = {tables.base_width_mm:g}, L3 = {tables.platform_width_mm:g} mm",
            color=SQUARE,
            fontsize=9,
        )
    return figure


def _nine_points(figure: Figure, axes: Axes, geometry: RobotGeometry, tables: SagTables) -> None:
    wall_axes(axes, "(a) Planar robot, nine points")
    region = reachable_region(geometry)
    fill_region(axes, region)
    draw_arcs(axes, region)
    x, y = np.array(tables.alpha_x_mm), np.array(tables.alpha_y_mm)
    fine_x, fine_y = np.linspace(x[0], x[-1], 101), np.linspace(y[0], y[-1], 101)
    rows = np.array([np.interp(fine_x, x, row) for row in tables.alpha_mm])
    values = np.array([np.interp(fine_y, y, column) for column in rows.T]).T
    step = 0.005
    levels = np.arange(np.floor(values.min() / step), np.ceil(values.max() / step) + 1) * step
    mesh = axes.contourf(fine_x, fine_y, values, levels=levels, cmap="YlOrBr", alpha=0.85, zorder=3)
    outline(axes, Rectangle(x[1], y[1], x[-1] - x[0], y[-1] - y[0]), SQUARE, None)
    for number, (place, sag_mm) in enumerate(tables.nine_points, start=1):
        axes.plot(*place, marker="o", markersize=4, color=INK, zorder=6)
        axes.annotate(
            f"{number}",
            place,
            (-4, 4),
            textcoords="offset points",
            ha="right",
            fontsize=9,
            fontweight="bold",
            zorder=7,
            path_effects=HALO,
        )
        axes.annotate(
            f"{sag_mm:.3f}",
            place,
            (4, -10),
            textcoords="offset points",
            fontsize=8.5,
            zorder=7,
            path_effects=HALO,
        )
    axes.set_xlim(x[0] - ROOM_MM, x[-1] + ROOM_MM)
    axes.set_ylim(y[0] - ROOM_MM, y[-1] + ROOM_MM)
    bar = figure.colorbar(
        mesh, cax=axes.inset_axes((1.03, 0.0, 0.05, 1.0)), format="%.3f", ticks=levels
    )
    bar.set_label("largest displacement (mm)")


def _slide(axes: Axes, geometry: RobotGeometry, tables: SagTables) -> None:
    axes.set_title("(b) Insertion slide", loc="left")
    axes.plot(
        tables.beta_rho3_mm,
        tables.beta_mm,
        color=LIMIT_COLOURS[Limit.RHO1_MIN],
        marker="o",
        markersize=4,
        linewidth=1.3,
    )
    slopes = np.diff(tables.beta_mm)
    for number, point in enumerate(zip(tables.beta_rho3_mm, tables.beta_mm, strict=True)):
        falls_before = number > 0 and slopes[number - 1] < 0
        rises_after = number < len(slopes) and slopes[number] > 0
        lowest = falls_before and rises_after
        rises = number == len(slopes) and not falls_before
        axes.annotate(
            f"{point[1]:.3f}",
            point,
            (0, -13) if lowest else (-5, 3) if rises else (5, 3),
            textcoords="offset points",
            ha="center" if lowest else "right" if rises else "left",
            fontsize=8.5,
            path_effects=HALO,
        )
    axes.set_xlabel(r"$\rho_3$ (mm)")
    axes.set_ylabel("largest displacement (mm)")
    axes.margins(0.14)
    axes.set_box_aspect(1)
    axes.grid(visible=True, color="#e6e6e6", linewidth=0.5)
    for edge_mm in (geometry.rho3.min_mm, geometry.rho3.max_mm):
        axes.axvline(edge_mm, color=INK, linewidth=0.7, linestyle=(0, (4, 3)))
    axes.text(
        0.5,
        0.84,
        "dashed: ends of the stroke",
        transform=axes.transAxes,
        ha="center",
        va="top",
        fontsize=8,
    )
