"""Maps over the workspace: condition number, forces of the carriages, speed, stroke, parallelogram.

All but the stroke depend on the height of the platform alone, so their levels are straight lines.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from twin.geometry import JointRange, RobotGeometry
from twin.statics import LoadCase
from twin.statics.loads import platform_push_n
from twin.study.demands import Demands
from twin.study.plots.style import INK, SQUARE, legend_below, new_figure, paper_height_mm, wall_axes
from twin.study.plots.workspace import outline, shape_name
from twin.workspace import (
    ArcPolygon,
    Measure,
    PlanarForce,
    Rectangle,
    WorkspaceMaps,
    reachable_region,
    workspace_maps,
)
from twin.workspace.boundary import Array

STEP_MM = 2.0

_ENDLESS = JointRange(min_mm=-10_000, max_mm=10_000)
"""Maps go a little beyond the strokes, so that the exact outline cuts them off."""


@dataclass(frozen=True, slots=True)
class MapPanel:
    """One map.

    Attributes:
        title: Above it.
        unit: Beside its scale.
        values: Shape (M, N), NaN outside.
        levels: Between which the colours change, ascending.
        colours: Name of the colour map.
        limit: A level that must not be crossed, if there is one.
    """

    title: str
    unit: str
    values: Array
    levels: tuple[float, ...]
    colours: str
    limit: float | None = None


def draw_maps(geometry: RobotGeometry, demands: Demands | None = None) -> Figure:
    """The figure: six maps with the regular square in each."""
    demands = demands or Demands()
    region = reachable_region(geometry)
    extent = region.extent
    # a cell around each place, so that the exact outline cuts the cells and not the workspace
    x = np.arange(extent.x_min_mm - STEP_MM, extent.x_max_mm + 2 * STEP_MM, STEP_MM)
    y = np.arange(extent.y_min_mm + 0.5 * STEP_MM, extent.y_max_mm + 2 * STEP_MM, STEP_MM)
    regular = Rectangle.of_box(geometry.regular_box)
    inside = region.contains_many(np.stack(np.meshgrid(x, y), axis=-1))
    size = (extent.x_max_mm - extent.x_min_mm, extent.y_max_mm - extent.y_min_mm)
    panel_mm = paper_height_mm(39.0, size, besides_mm=14.0)
    figure = new_figure(2 * min(max(panel_mm, 34.0), 90.0) + 18.0)
    axes_of_panels = figure.subplots(2, 3, sharex=True, sharey=True).ravel().tolist()
    for axes, panel in zip(axes_of_panels, map_panels(geometry, demands, x, y), strict=True):
        wall_axes(axes, panel.title)
        clip = _outline_of(region)
        axes.add_patch(clip)
        seen = panel.values[inside & np.isfinite(panel.values)]
        _draw(axes, x, y, panel, clip=clip, scale=_scale(panel, seen))
        name = f"regular {shape_name(regular)}" if axes is axes_of_panels[0] else None
        outline(axes, regular, SQUARE, name)
        axes.label_outer()
        axes.set_xlim(extent.x_min_mm - 0.03 * size[0], extent.x_max_mm + 0.03 * size[0])
        axes.set_ylim(extent.y_min_mm - 0.03 * size[1], extent.y_max_mm + 0.03 * size[1])
    axes_of_panels[0].plot([], [], color=INK, linewidth=1.0, linestyle="--", label="limit")
    legend_below(figure, columns=2)
    return figure


def map_panels(
    geometry: RobotGeometry, demands: Demands, x: Array, y: Array
) -> tuple[MapPanel, ...]:
    """What the six maps show, on the grid of all x (N,) and all y (M,)."""
    whole = geometry.model_copy(update=dict.fromkeys(("rho1", "rho2"), _ENDLESS))
    maps = {
        case: workspace_maps(
            whole, x, y, PlanarForce(0.0, platform_push_n(geometry, demands.loads, case))
        )
        for case in (LoadCase.INSERTING, LoadCase.WITHDRAWING)
    }
    any_map = maps[LoadCase.INSERTING]
    bar_mm = np.hypot(0.5 * geometry.platform_width_mm, geometry.e_py_mm)
    sine = any_map.of(Measure.PARALLELOGRAM_AREA) / (geometry.leg_length_mm * bar_mm)
    limit_n = min(demands.limits.rho1_n, demands.limits.rho2_n)
    force_levels = (0.0, 5.0, 10.0, 20.0, 30.0, 50.0, 75.0, 100.0, 150.0, 200.0, 300.0)
    return (
        MapPanel(
            "(a) Condition number", "condition number (-)", any_map.of(Measure.CONDITION),
            (1, 1.25, 1.5, 2, 3, 5, 10, 20), "YlGnBu", demands.max_condition,
        ),
        MapPanel(
            "(b) Force, inserting", "carriage force (N)", _force(maps[LoadCase.INSERTING]),
            force_levels, "YlOrRd", limit_n,
        ),
        MapPanel(
            "(c) Force, withdrawing", "carriage force (N)", _force(maps[LoadCase.WITHDRAWING]),
            force_levels, "YlOrRd", limit_n,
        ),
        MapPanel(
            "(d) Greatest speed of $V$", "per speed of the carriages (-)",
            any_map.of(Measure.SPEED_MAX), (0.7, 0.8, 1, 1.25, 1.5, 2, 3, 5, 10), "PuBuGn",
        ),
        MapPanel(
            "(e) Stroke left", "to the nearest end (mm)", _stroke_left(geometry, any_map),
            (0, 10, 25, 50, 75, 100, 125, 150, 200, 300), "GnBu", demands.margin_mm,
        ),
        MapPanel(
            "(f) Parallelogram", "sine of its angle (-)", sine,
            (0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95, 1), "BuPu",
            demands.singularity.parallelogram,
        ),
    )  # fmt: skip


def _force(maps: WorkspaceMaps) -> Array:
    forces: Array = np.maximum(np.abs(maps.of(Measure.FORCE1)), np.abs(maps.of(Measure.FORCE2)))
    return forces


def _stroke_left(geometry: RobotGeometry, maps: WorkspaceMaps) -> Array:
    """Distance of the joints from the nearest end of their travel, negative beyond it."""
    left: Array = np.min(
        [
            maps.rho1_mm - geometry.rho1.min_mm,
            geometry.rho1.max_mm - maps.rho1_mm,
            maps.rho2_mm - geometry.rho2.min_mm,
            geometry.rho2.max_mm - maps.rho2_mm,
        ],
        axis=0,
    )
    return left


def _outline_of(region: ArcPolygon) -> PathPatch:
    """The exact boundary, to be drawn and to cut a map off with."""
    whole = Path.make_compound_path(*(Path(line, closed=True) for line in region.polylines()))
    return PathPatch(whole, facecolor="none", edgecolor=INK, linewidth=0.9, zorder=4)


class _Scale(NamedTuple):
    levels: list[float]
    extend: str  # "neither", "min", "max" or "both", as matplotlib calls values beyond the levels
    limit: float | None  # None too if no value in the workspace comes that far


def _scale(panel: MapPanel, seen: Array) -> _Scale:
    """The levels from the last one below all values seen to the first one above them."""
    levels = np.array(panel.levels)
    least, greatest = float(seen.min()), float(seen.max())
    first = int(np.searchsorted(levels, least, side="right")) - 1
    last = int(np.searchsorted(levels, greatest, side="left"))
    first = min(max(first, 0), len(levels) - 2)
    last = max(min(last, len(levels) - 1), first + 1)
    below, above = least < levels[first], greatest > levels[last]
    extend = {(0, 0): "neither", (1, 0): "min", (0, 1): "max", (1, 1): "both"}
    reached = panel.limit is not None and least < panel.limit < greatest
    return _Scale(
        levels[first : last + 1].tolist(),
        extend[int(below), int(above)],
        panel.limit if reached else None,
    )


def _draw(
    axes: Axes, x: Array, y: Array, panel: MapPanel, *, clip: PathPatch, scale: _Scale
) -> None:
    """One map with its scale beside it."""
    axes.grid(visible=False)
    levels = scale.levels
    filled = axes.contourf(
        x, y, panel.values, levels=levels, cmap=panel.colours,
        norm=BoundaryNorm(levels, 256), extend=scale.extend, zorder=1,
    )  # fmt: skip
    lines = axes.contour(x, y, panel.values, levels=levels, colors="white", linewidths=0.5)
    for part in (filled, lines):
        part.set_clip_path(clip)
    bar = axes.figure.colorbar(
        filled, cax=axes.inset_axes((1.03, 0.0, 0.05, 1.0)), ticks=levels, format="%g"
    )
    bar.set_label(panel.unit)
    bar.ax.minorticks_off()
    if scale.limit is not None:
        edge = axes.contour(
            x, y, panel.values, levels=[scale.limit], colors=INK, linewidths=1.0, linestyles="--"
        )
        edge.set_clip_path(clip)
        bar.ax.axhline(scale.limit, color=INK, linewidth=1.0, linestyle="--")
