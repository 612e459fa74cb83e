"""Adding and moving nodes of the picture, in the project's units."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal

import numpy as np
from viser import (
    FrameHandle,
    GlbHandle,
    LabelHandle,
    MeshHandle,
    SceneApi,
    SceneNodeHandle,
)

from twin.scene.frames import METRES_PER_MM, UPRIGHT, Quaternion, Vector, metres, quaternion
from twin.scene.glb import Part, to_glb
from twin.scene.materials import Rgb
from twin.scene.shapes import Mesh
from twin.scene.state import Pose

ORIGIN: Vector = (0.0, 0.0, 0.0)

Anchor = Literal["top-center", "bottom-center", "center-left", "center-right"]
_FONT_SCALE = 0.9


def add_pivot(scene: SceneApi, name: str, *, visible: bool = True) -> FrameHandle:
    """An invisible node that only carries others."""
    return scene.add_frame(name, show_axes=False, visible=visible)


def add_part(
    scene: SceneApi,
    name: str,
    parts: Iterable[Part],
    *,
    at_mm: Vector = ORIGIN,
    wxyz: Quaternion = UPRIGHT,
    shadow: bool = True,
) -> GlbHandle:
    """A node with the meshes of one part, placed in its parent's frame."""
    glb = to_glb(parts)
    return scene.add_glb(name, glb, position=metres(at_mm), wxyz=wxyz, cast_shadow=shadow)


def add_signal(
    scene: SceneApi,
    name: str,
    mesh: Mesh,
    color: Rgb,
    *,
    opacity: float | None = None,
    scale: Vector = (1.0, 1.0, 1.0),
) -> MeshHandle:
    """A node of one plain colour that may change; it throws no shadow."""
    return scene.add_mesh_simple(
        name,
        vertices=(mesh.vertices_mm * METRES_PER_MM).astype(np.float32),
        faces=mesh.faces,
        color=color,
        opacity=opacity,
        scale=scale,
        side="front" if opacity is not None else "double",
        cast_shadow=False,
        receive_shadow=False,
    )


def add_label(
    scene: SceneApi,
    name: str,
    text: str,
    *,
    at_mm: Vector = ORIGIN,
    anchor: Anchor = "bottom-center",
    visible: bool = True,
) -> LabelHandle:
    """Words of one size on the screen, however far away."""
    return scene.add_label(
        name,
        text,
        position=metres(at_mm),
        font_screen_scale=_FONT_SCALE,
        anchor=anchor,
        visible=visible,
    )


def set_text(label: LabelHandle, text: str) -> None:
    """Changes a label's words; sends nothing if they are the same."""
    if label.text != text:
        label.text = text


def set_visible(node: SceneNodeHandle, *, visible: bool) -> None:
    """Shows or hides a node with all that hangs on it; sends nothing if it is so already."""
    if node.visible != visible:
        node.visible = visible


def place(node: SceneNodeHandle, position_mm: Vector, wxyz: Quaternion | None = None) -> None:
    """Moves a node in its parent's frame; sends nothing if it is there already.

    Comparing costs as much as sending: leave out what never changes.
    """
    node.position = metres(position_mm)
    if wxyz is not None:
        node.wxyz = wxyz


def place_transform(node: SceneNodeHandle, transform: Pose) -> None:
    """Moves a node to a homogeneous transform."""
    node.position = metres(transform[:3, 3])
    node.wxyz = quaternion(transform[:3, :3])


def turn_to(node: SceneNodeHandle, wxyz: Quaternion) -> None:
    """Turns a node about its own pivot; sends nothing if it is turned so already."""
    node.wxyz = wxyz
