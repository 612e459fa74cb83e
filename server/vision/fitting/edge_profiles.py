"""Where the edges of the code really are in the picture, measured along their normals."""

from __future__ import annotations

import math
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.vision.fitting.blurred_code import BlurredCode
from server.vision.fitting.code_edges import CodeEdges
from server.vision.fitting.light_picture import LightPicture
from server.vision.fitting.median import median
from server.vision.projection import Array, project

REACH_MODULES = 0.5
"""Profiles reach this far to both sides: beyond it the next edge begins to count."""

MOST_REACH_PX = 12.0
_MOST_HALF_STEPS = 16
_LEAST_GAIN, _MOST_GAIN = 0.05, 1.5
_LINES = np.array((-1 / 3, 0.0, 1 / 3), dtype=np.float32)  # side by side, of an edge's length


class ProfileLevels(NamedTuple):
    """Black and contrast where each edge lies, and how they change towards white, shapes (n,)."""

    black: Array
    black_per_mm: Array
    contrast: Array
    contrast_per_mm: Array


class EdgeOffsets(NamedTuple):
    """Measured distances of the edges from where a pose predicts them.

    Attributes:
        offset_px: Along the picture's normal, positive towards white, shape (n,) [px].
        by_pose: Derivative of the predicted place along the normal by (omega, tau), shape (n, 6).
        contrast: Grey step from black to white, negative where the picture contradicts, (n,).
        visible: Whole profile inside the picture, shape (n,).
        by_row_way: Derivative of the predicted place along the normal by the way per row, (n, 2).
        gain: Derivative of the offset by a shift of the edge: 1 where the profile holds all of
            the edge, less where blur or motion carry it beyond the ends, shape (n,).
        variance_px2: Second central moment of the gradient: the edge's blur squared, shape (n,).
        black: Grey value at the black end of the profile, shape (n,).
        white: The same at the white end.
    """

    offset_px: Array
    by_pose: Array
    contrast: Array
    visible: NDArray[np.bool_]
    by_row_way: Array
    gain: Array
    variance_px2: Array
    black: Array
    white: Array

    def width_px(self, among: NDArray[np.bool_] | None = None) -> float:
        """Standard deviation of the typical edge's blur [px]; 0 if no edge is seen."""
        usable = self.visible & (self.contrast > 0)
        if among is not None:
            usable &= among
        if not np.any(usable):
            return 0.0
        return math.sqrt(max(median(self.variance_px2[usable]), 0.0))


def edge_offsets(
    picture: LightPicture,
    camera: CameraModel,
    edges: CodeEdges,
    T_camera_label: Array,
    *,
    inverted: bool = False,
    spread_px: Array | float = 0.0,
    reach_px: float = MOST_REACH_PX,
    levels: ProfileLevels | None = None,
    row_way: Array | None = None,
    expected: BlurredCode | None = None,
) -> EdgeOffsets:
    """Sample the light across every edge and take the centroid of their gradient.

    Args:
        picture: The light around the label.
        camera: Intrinsics and distortion.
        edges: Edges in label coordinates.
        T_camera_label: Predicted pose, shape (4, 4) [mm].
        inverted: The code is white on black.
        spread_px: Expected shift of the edges towards white, one or one each; profiles are
            centred there.
        reach_px: Half length of the profiles, where half a module is not shorter.
        levels: Local black and contrast to measure against; None takes the grey values.
        row_way: How far the label moves in the picture from one row's exposure to the next,
            shape (2,) [px]; the pose is that of the middle row.
        expected: The blurred code, whose own centroids are taken away.
    """
    seen = project(camera, T_camera_label, edges.points_mm)
    rows = seen.pixels[:, 1:] - picture.middle_row
    pixels = seen.pixels if row_way is None else seen.pixels + rows * row_way
    in_plane = seen.by_point @ T_camera_label[:3, :2]  # pixel by label x and y, (n, 2, 2)
    to_white = np.einsum("nij,nj->ni", in_plane, edges.normals)
    along = np.einsum("nij,nj->ni", in_plane, edges.tangents)
    normal = along[:, ::-1] * (1.0, -1.0)
    normal /= np.sqrt(normal[:, :1] ** 2 + normal[:, 1:] ** 2)
    across = normal[:, 0] * to_white[:, 0] + normal[:, 1] * to_white[:, 1]  # label mm -> px
    normal *= np.sign(across)[:, None]
    across = np.abs(across)

    half_module = across * edges.module_mm * REACH_MODULES
    reach = np.clip(half_module - np.abs(spread_px), 1.0, reach_px)
    longest = float(np.max(reach, initial=2.0))
    # Steps of a pixel, but of half a pixel across the short profiles of sharp edges.
    half_steps = min(int(np.ceil(max(longest, min(2 * longest, 6.0)))), _MOST_HALF_STEPS)
    steps = (np.arange(-half_steps, half_steps + 1) / half_steps).astype(np.float32)
    middle = pixels - picture.left_top_px + normal * np.reshape(spread_px, (-1, 1))
    forward = normal * reach[:, None]
    beside = along * edges.length_mm
    extent = np.abs(forward) + np.abs(beside) / 3
    last = (picture.light.shape[1] - 1, picture.light.shape[0] - 1)
    visible = np.all((middle >= extent) & (middle + extent <= last), axis=1)
    grey = _profiles(picture.light, middle, beside, forward, steps)
    if inverted:
        grey = 255 - grey
    black, white = grey[:, 0].astype(np.float64), grey[:, -1].astype(np.float64)
    if levels is not None:
        grey = _levelled(grey, levels, spread_px / across, reach / across, steps)

    gradient = grey[:, 1:] - grey[:, :-1]
    middles = (steps[:-1] + steps[1:]) / 2
    contrast = gradient.sum(axis=1).astype(np.float64)
    safe = np.where(contrast > 0, contrast, 1.0)
    moments = gradient @ np.column_stack((middles, middles**2))
    centroid = moments[:, 0] / safe * reach
    variance = moments[:, 1] / safe * reach**2 - centroid**2
    if expected is not None:
        forward_mm = np.einsum("nij,nj->ni", np.linalg.inv(in_plane), forward)
        centroid = centroid - _expected_centroid(expected, edges, forward_mm, steps) * reach
    offset = np.clip(centroid, -reach, reach) + spread_px
    offset[~visible | (contrast <= 0)] = 0.0
    by_pose = seen.by_pose_along(normal)
    gain = _gain(gradient, moments[:, 0] / safe, safe, half_steps)
    return EdgeOffsets(
        offset_px=offset,
        by_pose=by_pose,
        contrast=contrast,
        visible=visible,
        by_row_way=normal * rows,
        gain=gain,
        variance_px2=variance,
        black=black,
        white=white,
    )


def _expected_centroid(
    expected: BlurredCode, edges: CodeEdges, forward_mm: Array, steps: NDArray[np.float32]
) -> Array:
    """Centroid of the same profiles of the blurred code on -1..1, shape (n,)."""
    count = len(edges.points_mm)
    beside = edges.tangents[:, None, None, :] * edges.length_mm * _LINES[:, None, None]
    across = forward_mm[:, None, None, :] * steps[:, None]
    places = edges.points_mm[:, None, None, :] + beside + across
    white = expected.at(places.reshape(count, -1, 2)).reshape(count, len(_LINES), -1).mean(axis=1)
    gradient = white[:, 1:] - white[:, :-1]
    contrast = gradient.sum(axis=1)
    middles = (steps[:-1] + steps[1:]) / 2
    safe = np.where(contrast > 0, contrast, np.inf)
    return np.asarray(np.clip(gradient @ middles / safe, -1, 1), dtype=np.float64)


def _gain(
    gradient: NDArray[np.float32],
    centroid: NDArray[np.float64],
    contrast: NDArray[np.float64],
    half_steps: int,
) -> Array:
    """How much of a shift of the grey values the centroid follows, shape (n,).

    With the gradient g on -1..1, c = int s g ds / int g ds; shifting g by d changes c by
    dc/dd = 1 - (g(1) + g(-1) - c (g(1) - g(-1))) / int g ds.
    """
    first, last = gradient[:, 0], gradient[:, -1]
    loss = half_steps * (first + last - centroid * (last - first))
    return np.clip(1 - loss / contrast, _LEAST_GAIN, _MOST_GAIN)


def _levelled(
    grey: NDArray[np.float32],
    levels: ProfileLevels,
    spread_mm: Array,
    reach_mm: Array,
    steps: NDArray[np.float32],
) -> NDArray[np.float32]:
    """Profiles relative to the local black (0) and white (1), shape (n, steps)."""
    black = levels.black + levels.black_per_mm * spread_mm
    contrast = levels.contrast + levels.contrast_per_mm * spread_mm
    lifted = grey - black.astype(np.float32)[:, None]
    lifted -= (levels.black_per_mm * reach_mm).astype(np.float32)[:, None] * steps
    slope = (levels.contrast_per_mm * reach_mm / contrast).astype(np.float32)[:, None]
    lifted /= contrast.astype(np.float32)[:, None] * (1 + slope * steps)
    return lifted


def _profiles(
    light: NDArray[np.float32],
    middle: Array,
    beside: Array,
    forward: Array,
    steps: NDArray[np.float32],
) -> NDArray[np.float32]:
    """Light along each edge's normal, the mean of a few lines side by side, (n, steps)."""
    count = len(middle)
    maps = []
    for axis in (0, 1):
        lines = middle[:, axis, None].astype(np.float32)
        lines = lines + beside[:, axis, None].astype(np.float32) * _LINES
        across = forward[:, axis, None].astype(np.float32) * steps
        maps.append((lines[:, :, None] + across[:, None, :]).reshape(count, -1))
    seen = cv2.remap(light, maps[0], maps[1], cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    lines = np.asarray(seen, dtype=np.float32).reshape(count, len(_LINES), len(steps))
    total = lines[:, 0] + lines[:, 1]
    total += lines[:, 2]
    total /= 3
    return total
