"""What the camera sees: a pyramid in front of its lens, with a place for its picture."""

from __future__ import annotations

import math

import numpy as np
from viser import SceneApi

from twin.scene.frames import METRES_PER_MM
from twin.scene.materials import VIEW
from twin.scene.nodes import add_pivot

PICTURE = "picture"
"""Node under the pyramid's whose picture a page may change for its own viewer.

Pictures of a camera are large: they do not go through the 3D library's connection.
"""
_DEPTH_MM = 300.0
_BEFORE_THE_RIM = 0.999


def add_frustum(scene: SceneApi, name: str, *, hfov_rad: float, aspect: float) -> None:
    """Adds the pyramid, hidden, under a node that has the camera's frame (z forward, y down).

    Args:
        scene: Scene to add to.
        name: Name of the new node.
        hfov_rad: Horizontal field of view.
        aspect: Width of the picture divided by its height.
    """
    add_pivot(scene, name, visible=False)
    depth = _DEPTH_MM * METRES_PER_MM
    half_width = depth * math.tan(hfov_rad / 2)
    half_height = half_width / aspect
    rim = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * (half_width, half_height)
    corners = np.column_stack([rim, np.full(4, depth)]).astype(np.float32)
    apex = np.zeros(3, dtype=np.float32)
    next_corners = np.roll(corners, -1, axis=0)
    rays = [np.stack([apex, corner]) for corner in corners]
    frame = [np.stack(pair) for pair in zip(corners, next_corners, strict=True)]
    scene.add_line_segments(
        f"{name}/edges",
        points=np.array(rays + frame),
        colors=VIEW,
        thickness=1.2,
        thickness_units="screen",
    )
    scene.add_mesh_simple(
        f"{name}/volume",
        vertices=np.vstack([apex, corners]),
        faces=np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]], dtype=np.uint32),
        color=VIEW,
        opacity=0.05,
        side="double",
        flat_shading=True,
        cast_shadow=False,
        receive_shadow=False,
    )
    scene.add_image(
        f"{name}/{PICTURE}",
        np.full((2, 2, 4), (*VIEW, 40), dtype=np.uint8),
        render_width=float(2 * half_width),
        render_height=float(2 * half_height),
        format="png",
        cast_shadow=False,
        receive_shadow=False,
        position=(0.0, 0.0, depth * _BEFORE_THE_RIM),
    )
