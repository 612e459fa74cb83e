"""The region that the platform reaches, where the regular box fits in it, and the box itself."""

from __future__ import annotations

import itertools
import logging

import numpy as np
from numpy.typing import NDArray
from viser import SceneApi

from twin.geometry import RobotGeometry
from twin.scene.frames import METRES_PER_MM, metres
from twin.scene.materials import PLACEMENT, REACH, REGION, Rgb
from twin.scene.nodes import add_label, add_pivot
from twin.scene.overlays import BOX, PLACEMENTS
from twin.scene.overlays import REGION as REGION_OVERLAY
from twin.scene.poses import region_center
from twin.workspace import (
    ArcPolygon,
    EmptyWorkspaceError,
    placement_region,
    reachable_region,
)

logger = logging.getLogger(__name__)

SAGITTA_MM = 0.1
"""Largest distance of a drawn line from the true arc."""


def reach_of(geometry: RobotGeometry) -> ArcPolygon | None:
    """All positions of V that the robot reaches, None if there are none."""
    try:
        return reachable_region(geometry)
    except EmptyWorkspaceError as error:
        logger.warning("The picture has no workspace to show: %s", error)
        return None


def add_regions(scene: SceneApi, geometry: RobotGeometry, reach: ArcPolygon | None) -> None:
    """Adds the outlines in the plane of V, at z = 0, and the box of plug-tip targets."""
    box = geometry.regular_box
    add_pivot(scene, REGION_OVERLAY.nodes[0], visible=False)
    add_pivot(scene, PLACEMENTS.nodes[0], visible=False)
    where = (box.center_x_mm, box.center_y_mm, 0.0)
    if reach is None:
        words = "This geometry reaches no position at all"
        add_label(scene, f"{REGION_OVERLAY.nodes[0]}/none", words, at_mm=where)
    else:
        _add_outline(scene, f"{REGION_OVERLAY.nodes[0]}/outline", reach, REACH)
        area_m2 = reach.area_mm2 * 1e-6
        at = (reach.extent.x_min_mm, reach.extent.y_max_mm + 30.0, 0.0)
        add_label(scene, f"{REGION_OVERLAY.nodes[0]}/area", f"{area_m2:.3f} m²", at_mm=at)
    name = PLACEMENTS.nodes[0]
    centres = placement_region(geometry, box.width_mm, box.height_mm)
    size = f"{box.width_mm:g} x {box.height_mm:g} mm"
    if centres.is_empty:
        add_label(scene, f"{name}/none", f"{size} fits nowhere", at_mm=where)
    else:
        _add_outline(scene, f"{name}/outline", centres, PLACEMENT)
        extent = centres.extent
        at = ((extent.x_min_mm + extent.x_max_mm) / 2, extent.y_min_mm - 12.0, 0.0)
        add_label(scene, f"{name}/size", f"centres for {size}", at_mm=at, anchor="top-center")
    _add_box(scene, geometry, BOX.nodes[0])


def segments_m(region: ArcPolygon) -> NDArray[np.float32]:
    """The boundary as straight pieces in the plane z = 0, shape (N, 2, 3) [m]."""
    pieces = []
    for line in region.polylines(SAGITTA_MM):
        points = np.column_stack([line, np.zeros(len(line))]) * METRES_PER_MM
        pieces.append(np.stack([points[:-1], points[1:]], axis=1))
    return np.concatenate(pieces).astype(np.float32)


def _add_outline(scene: SceneApi, name: str, region: ArcPolygon, color: Rgb) -> None:
    scene.add_line_segments(
        name,
        points=segments_m(region),
        colors=color,
        thickness=2.5,
        thickness_units="screen",
    )


def _add_box(scene: SceneApi, geometry: RobotGeometry, name: str) -> None:
    """The regular box of plug-tip targets, translucent with bright edges."""
    add_pivot(scene, name, visible=False)
    box = geometry.regular_box
    size = np.array([box.width_mm, box.height_mm, box.depth_mm]) * METRES_PER_MM
    center = metres(region_center(geometry))
    scene.add_box(
        f"{name}/volume",
        color=REGION,
        dimensions=(float(size[0]), float(size[1]), float(size[2])),
        opacity=0.10,
        side="double",
        cast_shadow=False,
        receive_shadow=False,
        position=center,
    )
    corners = np.array(list(itertools.product((-0.5, 0.5), repeat=3)))
    edges = [(a, b) for a, b in itertools.combinations(corners, 2) if np.count_nonzero(a != b) == 1]
    scene.add_line_segments(
        f"{name}/edges",
        points=np.array(edges, dtype=np.float32) * size.astype(np.float32),
        colors=REGION,
        thickness=1.5,
        thickness_units="screen",
        position=center,
    )
    x, y, z = region_center(geometry)
    words = f"{box.width_mm:g} x {box.height_mm:g} x {box.depth_mm:g} mm"
    add_label(scene, f"{name}/size", words, at_mm=(x, y + box.height_mm / 2 + 10.0, z))
