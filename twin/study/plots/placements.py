"""Where the regular square can be put: all its centres, and the square at the ends of them."""

from __future__ import annotations

import math

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from twin.geometry import RobotGeometry
from twin.study.plots.style import (
    GREY,
    HALO,
    INK,
    LARGEST,
    SQUARE,
    legend_below,
    new_figure,
    paper_height_mm,
    wall_axes,
)
from twin.study.plots.workspace import draw_arcs, fill_region, outline, shape_name, size_text
from twin.workspace import ArcPolygon, Rectangle, placement_region, reachable_region

CENTERS_FILL = "#bfe3d6"


def draw_placements(geometry: RobotGeometry) -> Figure:
    """The figure: on the left the whole workspace, on the right the centres from near."""
    box = geometry.regular_box
    regular = Rectangle.of_box(box)
    centers = placement_region(geometry, box.width_mm, box.height_mm)
    low, high, left, right = _seen(reachable_region(geometry), regular)
    height_mm = paper_height_mm(62.0, (right - left, high - low), besides_mm=36.0)
    figure = new_figure(min(max(height_mm, 66.0), 150.0))
    left, right = figure.subplots(1, 2)
    _whole(left, geometry, regular, centers)
    _centers_from_near(right, regular, centers)
    legend_below(figure)
    return figure


def _seen(region: ArcPolygon, regular: Rectangle) -> tuple[float, float, float, float]:
    """Lowest, highest, leftmost and rightmost of what the left panel shows [mm]."""
    extent = region.extent
    return (
        min(extent.y_min_mm, regular.y_min_mm),
        max(extent.y_max_mm, regular.y_max_mm),
        min(extent.x_min_mm, regular.x_min_mm),
        max(extent.x_max_mm, regular.x_max_mm),
    )


def _whole(axes: Axes, geometry: RobotGeometry, regular: Rectangle, centers: ArcPolygon) -> None:
    wall_axes(axes, f"(a) Placements of {size_text(regular)}")
    region = reachable_region(geometry)
    fill_region(axes, region)
    draw_arcs(axes, region)
    name = shape_name(regular)
    _fill(axes, centers, f"centres of the {name}")
    for number, vertex in enumerate(centers.vertices):
        outline(
            axes,
            Rectangle(vertex.x_mm, vertex.y_mm, regular.width_mm, regular.height_mm),
            GREY,
            f"the {name} about a corner of them" if number == 0 else None,
            dashes=(3, 2),
        )
    outline(axes, regular, SQUARE, f"regular {name}")
    axes.plot(regular.center_x_mm, regular.center_y_mm, marker="+", color=SQUARE, zorder=8)
    axes.margins(0.04)


def _centers_from_near(axes: Axes, regular: Rectangle, centers: ArcPolygon) -> None:
    if centers.is_empty:
        axes.set_axis_off()
        axes.text(0.5, 0.5, "It fits nowhere.", transform=axes.transAxes, ha="center")
        return
    wall_axes(axes, f"(b) Centres, {centers.area_mm2:.0f} mm$^2$")
    _fill(axes, centers, None)
    draw_arcs(axes, centers, named=False)
    extent = centers.extent
    middle_x = 0.5 * (extent.x_min_mm + extent.x_max_mm)
    middle_y = 0.5 * (extent.y_min_mm + extent.y_max_mm)
    for vertex in centers.vertices:
        dx, dy = vertex.x_mm - middle_x, vertex.y_mm - middle_y
        sideways = abs(dx) > abs(dy)
        axes.annotate(
            f"({vertex.x_mm:.1f}, {vertex.y_mm:.1f})",
            vertex,
            (math.copysign(6, dx) if sideways else 0, 0 if sideways else math.copysign(9, dy)),
            textcoords="offset points",
            ha="center" if not sideways else "left" if dx > 0 else "right",
            va="center",
            fontsize=8,
            color=INK,
            zorder=9,
            path_effects=HALO,
        )
    axes.plot(regular.center_x_mm, regular.center_y_mm, marker="+", markersize=9, color=SQUARE)
    axes.margins(0.55, 0.12)


def _fill(axes: Axes, centers: ArcPolygon, label: str | None) -> None:
    for line in centers.polylines():
        axes.add_patch(
            Polygon(line, facecolor=CENTERS_FILL, edgecolor=LARGEST, label=label, zorder=2)
        )
