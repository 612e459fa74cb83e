"""The regular box of targets, as a translucent volume with bright edges."""

from __future__ import annotations

import itertools

import numpy as np
from viser import SceneApi

from twin.geometry import RobotGeometry
from twin.scene.frames import METRES_PER_MM, metres
from twin.scene.materials import REGION
from twin.scene.poses import region_center


def add_workspace_region(scene: SceneApi, geometry: RobotGeometry, name: str = "/region") -> None:
    """Adds the regular box at its place in the base frame."""
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
