"""Where the edges of the code really are in the picture, measured along their normals."""

from __future__ import annotations

from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.vision.code_edges import CodeEdges
from server.vision.projection import Array, project

REACH_MODULES = 0.5
"""Profiles reach this far to both sides: beyond it the next edge begins to count."""

MOST_REACH_PX = 12.0
_SIDEWAYS_MODULES = (-0.25, 0.0, 0.25)


class EdgeOffsets(NamedTuple):
    """Measured distances of the edges from where a pose predicts them.

    Attributes:
        offset_px: Along the picture's normal, positive towards white, shape (n,) [px].
        by_pose: Derivative of the predicted place along the normal by (omega, tau), shape (n, 6).
        contrast: Grey step from black to white, negative where the picture contradicts, (n,).
        visible: Whole profile inside the picture, shape (n,).
        width_px: Standard deviation of the typical edge's blur [px].
    """

    offset_px: Array
    by_pose: Array
    contrast: Array
    visible: NDArray[np.bool_]
    width_px: float


def edge_offsets(
    image: NDArray[np.uint8],
    camera: CameraModel,
    edges: CodeEdges,
    T_camera_label: Array,
    *,
    inverted: bool = False,
    spread_px: float = 0.0,
    reach_px: float = MOST_REACH_PX,
) -> EdgeOffsets:
    """Sample the grey values across every edge and take the centroid of their gradient.

    Args:
        image: Grey values, shape (height, width).
        camera: Intrinsics and distortion.
        edges: Edges in label coordinates.
        T_camera_label: Predicted pose, shape (4, 4) [mm].
        inverted: The code is white on black.
        spread_px: Expected shift of all edges towards white; profiles are centred there.
        reach_px: Half length of the profiles, where half a module is not shorter.
    """
    seen = project(camera, T_camera_label, edges.points_mm)
    in_plane = seen.by_point @ T_camera_label[:3, :2]  # pixel by label x and y, (n, 2, 2)
    to_white = np.einsum("nij,nj->ni", in_plane, edges.normals)
    along = np.einsum("nij,nj->ni", in_plane, edges.normals[:, ::-1] * (-1.0, 1.0))
    normal = along[:, ::-1] * (1.0, -1.0)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    across = np.einsum("ni,ni->n", normal, to_white)  # label mm along the normal -> px
    normal *= np.sign(across)[:, None]

    half_module = np.abs(across) * edges.module_mm * REACH_MODULES
    reach = np.clip(half_module - abs(spread_px), 1.0, reach_px)
    longest = float(np.max(reach, initial=2.0))
    # Steps of a pixel, but of half a pixel across the short profiles of sharp edges.
    half_steps = int(np.ceil(max(longest, min(2 * longest, 6.0))))
    steps = np.arange(-half_steps, half_steps + 1) / half_steps
    sideways = np.array(_SIDEWAYS_MODULES) * edges.module_mm
    middle = seen.pixels + normal * spread_px
    taps = middle[:, :, None] + along[:, :, None] * sideways  # (n, 2, 3)
    grid = taps.astype(np.float32)[..., None] + (
        (normal * reach[:, None]).astype(np.float32)[:, :, None, None] * steps.astype(np.float32)
    )
    last = np.array([image.shape[1], image.shape[0]], dtype=np.float32)[:, None] - 1
    ends = grid[..., (0, -1)].reshape(len(grid), 2, -1)
    visible = np.all((ends >= 0) & (ends <= last), axis=(1, 2))
    grey = _sample(image, grid[:, 0], grid[:, 1]).mean(axis=1)

    gradient = np.diff(grey, axis=1)
    if inverted:
        gradient = -gradient
    middles = (steps[:-1] + steps[1:]) / 2
    contrast = gradient.sum(axis=1)
    safe = np.where(contrast > 0, contrast, 1.0)
    centroid = gradient @ middles / safe * reach
    usable = visible & (contrast > 0)
    offset = np.where(usable, np.clip(centroid, -reach, reach) + spread_px, 0.0)
    variance = gradient @ middles**2 / safe * reach**2 - centroid**2
    width = float(np.sqrt(max(np.median(variance[usable]), 0.0))) if np.any(usable) else 0.0
    by_pose = np.einsum("ni,nij->nj", normal, seen.by_pose)
    return EdgeOffsets(offset, by_pose, contrast, visible, width)


def _sample(
    image: NDArray[np.uint8], x: NDArray[np.float32], y: NDArray[np.float32]
) -> NDArray[np.float32]:
    """Grey values at fractional pixels, bilinear, shape of x."""
    shape = x.shape
    # remap works on float32 to keep the fractions that uint8 would round away; only the region
    # that is looked at is converted. It wants plane maps.
    height, width = image.shape
    left, right = _span(x, width)
    top, bottom = _span(y, height)
    region = image[top:bottom, left:right].astype(np.float32)
    map_x = (x - np.float32(left)).reshape(shape[0], -1)
    map_y = (y - np.float32(top)).reshape(shape[0], -1)
    values = cv2.remap(region, map_x, map_y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    return np.asarray(values, dtype=np.float32).reshape(shape)


def _span(values: NDArray[np.float32], size: int) -> tuple[int, int]:
    """First and one past the last pixel that interpolation touches, inside the picture."""
    low = int(np.clip(np.floor(values.min()), 0, size - 1))
    high = int(np.clip(np.ceil(values.max()) + 1, low + 1, size))
    return low, high
