"""Numbers over the workspace in colours: how near a singularity, and how far the robot sags."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from viser import SceneApi

from twin.geometry import RobotGeometry
from twin.scene.frames import METRES_PER_MM, metres
from twin.scene.nodes import add_label, add_pivot
from twin.scene.overlays import CONDITION, SAG
from twin.scene.overlays.colors import GOOD_TO_BAD, ColorScale, add_legend
from twin.statics import SagTables
from twin.workspace import ArcPolygon, Measure, measure_rows

STEP_MM = 2.5
WORST_CONDITION = 6.0
"""Condition number from which the map is red: there the carriages move the platform six times
better one way than the other."""

_OPACITY = 0.55
_LEGEND_GAP = 70.0
_POINT_MM = 12.0


def condition_picture(geometry: RobotGeometry, reach: ArcPolygon) -> NDArray[np.uint8]:
    """Condition number of the platform's Jacobian over the reach, RGBA, shape (rows, columns, 4).

    Row 0 is the lowest. What is not reached is transparent; the outline's pixels are partly so,
    by the share of nine points of the pixel that are inside.
    """
    extent = reach.extent
    columns = max(1, round((extent.x_max_mm - extent.x_min_mm) / STEP_MM))
    rows = max(1, round((extent.y_max_mm - extent.y_min_mm) / STEP_MM))
    x = _middles(extent.x_min_mm, extent.x_max_mm, columns)
    y = _middles(extent.y_min_mm, extent.y_max_mm, rows)
    parts = np.array([-1, 0, 1]) / 3
    fine_x = (x[:, None] + parts * (x[1] - x[0] if columns > 1 else 0)).ravel()
    fine_y = (y[:, None] + parts * (y[1] - y[0] if rows > 1 else 0)).ravel()
    inside = reach.contains_many(np.stack(np.meshgrid(fine_x, fine_y), axis=-1))
    share = inside.reshape(rows, 3, columns, 3).mean(axis=(1, 3))
    conditions = np.nan_to_num(measure_rows(geometry, Measure.CONDITION, y), nan=np.inf)
    picture = np.zeros((rows, columns, 4), dtype=np.uint8)
    picture[..., :3] = _scale().rgb(conditions)[:, None]
    picture[..., 3] = np.round(255 * _OPACITY * share)
    return picture


def add_condition_map(scene: SceneApi, geometry: RobotGeometry, reach: ArcPolygon | None) -> None:
    """Adds the map in the plane of V with its legend beside it."""
    name = CONDITION.nodes[0]
    add_pivot(scene, name, visible=False)
    if reach is None:
        return
    extent = reach.extent
    width, height = extent.x_max_mm - extent.x_min_mm, extent.y_max_mm - extent.y_min_mm
    middle = ((extent.x_min_mm + extent.x_max_mm) / 2, (extent.y_min_mm + extent.y_max_mm) / 2)
    scene.add_image(
        f"{name}/map",
        condition_picture(geometry, reach),
        render_width=width * METRES_PER_MM,
        render_height=height * METRES_PER_MM,
        format="png",
        cast_shadow=False,
        receive_shadow=False,
        position=metres((*middle, 0.0)),
    )
    add_legend(
        scene,
        f"{name}/legend",
        _scale(),
        title="condition",
        ends=("1", f"≥ {WORST_CONDITION:g}"),
        foot_mm=(extent.x_max_mm + _LEGEND_GAP, extent.y_min_mm + 0.2 * height, 0.0),
        height_mm=0.6 * height,
    )


def add_nine_points(scene: SceneApi, geometry: RobotGeometry, tables: SagTables) -> None:
    """Adds a point at each of the nine points, coloured by the sag there, with a legend."""
    name = SAG.nodes[0]
    add_pivot(scene, name, visible=False)
    sags = np.array(tables.alpha_mm).ravel()
    scale = ColorScale(float(sags.min()), float(sags.max()), GOOD_TO_BAD)
    points = np.array([(v.x_mm, v.y_mm, 0.0) for v, _ in tables.nine_points])
    scene.add_point_cloud(
        f"{name}/points",
        points=(points * METRES_PER_MM).astype(np.float32),
        colors=scale.rgb(sags),
        point_size=_POINT_MM * METRES_PER_MM,
        point_shape="circle",
    )
    box = geometry.regular_box
    foot = (
        box.center_x_mm + box.width_mm / 2 + _LEGEND_GAP,
        box.center_y_mm - box.height_mm / 2,
        0.0,
    )
    ends = (f"{scale.low:.3f} mm", f"{scale.high:.3f} mm")
    add_legend(
        scene, f"{name}/legend", scale, title="sag", ends=ends, foot_mm=foot,
        height_mm=box.height_mm,
    )  # fmt: skip
    worst = int(sags.argmax())
    x, y, z = points[worst]
    add_label(scene, f"{name}/worst", f"{sags[worst]:.3f} mm", at_mm=(x, y + 16.0, z))


def _scale() -> ColorScale:
    return ColorScale(1.0, WORST_CONDITION, GOOD_TO_BAD)


def _middles(low: float, high: float, count: int) -> NDArray[np.float64]:
    return low + (np.arange(count) + 0.5) * (high - low) / count
