"""The workspace of V with the arcs that bound it, the regular square and the largest one."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from matplotlib.patches import Rectangle as RectanglePatch

from twin.geometry import RobotGeometry
from twin.kinematics import alpha
from twin.kinematics.alpha import PlatformPosition
from twin.study.plots.robot import draw_rail, draw_robot
from twin.study.plots.style import (
    INK,
    LARGEST,
    LIMIT_COLOURS,
    LIMIT_NAMES,
    REGION_FILL,
    SQUARE,
    legend_below,
    new_figure,
    paper_height_mm,
    wall_axes,
)
from twin.workspace import ArcPolygon, Rectangle, fits, largest_rectangle, reachable_region

POINTS_PER_PIECE = 120


def draw_workspace(geometry: RobotGeometry) -> Figure:
    """The figure: workspace, both squares, and the robot in the middle of the regular one."""
    region = reachable_region(geometry)
    regular = Rectangle.of_box(geometry.regular_box)
    figure = new_figure(figure_height_mm(geometry, region, regular))
    axes = figure.add_subplot()
    wall_axes(axes, "Workspace of the platform")
    fill_region(axes, region)
    draw_arcs(axes, region)
    draw_rail(axes, geometry)
    largest = largest_rectangle(geometry).rectangle
    outline(axes, largest, LARGEST, f"largest square, {largest.width_mm:.1f} mm", dashes=(4, 2))
    inside = "" if fits(geometry, regular) else ", not inside"
    label = f"regular {shape_name(regular)}, {size_text(regular)}{inside}"
    outline(axes, regular, SQUARE, label)
    _draw_in_the_middle(axes, geometry, regular)
    axes.margins(0.03)
    legend_below(figure)
    return figure


def figure_height_mm(geometry: RobotGeometry, region: ArcPolygon, regular: Rectangle) -> float:
    """Height on paper of a figure of the whole robot, legend included."""
    extent = region.extent
    rail_end = geometry.base_width_mm + max(0.0, -geometry.e2x_mm)
    left = min(0.0, geometry.e1x_mm, extent.x_min_mm, regular.x_min_mm)
    right = max(rail_end, extent.x_max_mm, regular.x_max_mm)
    low = min(geometry.e1y_mm, geometry.e1y_mm + geometry.e_py_mm, geometry.e2y_mm)
    low = min(low, regular.y_min_mm)
    high = max(extent.y_max_mm, regular.y_max_mm)
    return paper_height_mm(158.0, (right - left, high - low), besides_mm=38.0)


def shape_name(rectangle: Rectangle) -> str:
    """What to call it."""
    return "square" if rectangle.width_mm == rectangle.height_mm else "rectangle"


def size_text(rectangle: Rectangle) -> str:
    """Width times height with its unit, as a formula is printed."""
    return rf"{rectangle.width_mm:g} $\times$ {rectangle.height_mm:g} mm"


def fill_region(axes: Axes, region: ArcPolygon, colour: str = REGION_FILL) -> None:
    """Fill a region with one colour."""
    for line in region.polylines():
        axes.add_patch(Polygon(line, facecolor=colour, edgecolor="none", zorder=1))


def draw_arcs(axes: Axes, region: ArcPolygon, *, named: bool = True) -> None:
    """Draw each piece of a boundary in the colour of the limit that makes it.

    Args:
        axes: Where to draw.
        region: Whose boundary.
        named: The limits stand in the legend.
    """
    known = set() if named else set(LIMIT_NAMES)
    order = list(LIMIT_NAMES)
    pieces = [piece for loop in region.loops for piece in loop]
    for piece in sorted(pieces, key=lambda piece: order.index(piece.limit)):
        points = piece.points(POINTS_PER_PIECE)
        label = None if piece.limit in known else LIMIT_NAMES[piece.limit]
        known.add(piece.limit)
        axes.plot(
            points[:, 0],
            points[:, 1],
            color=LIMIT_COLOURS[piece.limit],
            linewidth=1.6,
            label=label,
            zorder=3,
        )
    for vertex in region.vertices:
        axes.plot(*vertex, marker=".", color=INK, markersize=3.5, zorder=4)


def outline(
    axes: Axes,
    rectangle: Rectangle,
    colour: str,
    label: str | None,
    *,
    dashes: tuple[float, float] | None = None,
    strength: float = 1.0,
) -> None:
    """Draw the edge of a rectangle."""
    patch = RectanglePatch(
        (rectangle.x_min_mm, rectangle.y_min_mm),
        rectangle.width_mm,
        rectangle.height_mm,
        facecolor="none",
        edgecolor=colour,
        linewidth=1.3,
        linestyle=(0, dashes) if dashes else "-",
        alpha=strength,
        label=label,
        zorder=5,
    )
    axes.add_patch(patch)


def _draw_in_the_middle(axes: Axes, geometry: RobotGeometry, regular: Rectangle) -> None:
    """The robot with V in the middle of the regular square, if it gets there."""
    if not fits(geometry, Rectangle.square(regular.center_x_mm, regular.center_y_mm, 1e-3)):
        return
    v = PlatformPosition(regular.center_x_mm, regular.center_y_mm)
    legs = alpha.leg_vectors(geometry, v, *alpha.inverse(geometry, v))
    draw_robot(axes, geometry, v, legs, pivots=True, strength=0.75)
