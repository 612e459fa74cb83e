"""Where the edges of the code really are in the picture, measured along their normals."""

from __future__ import annotations

import math
from functools import lru_cache
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
_QUARTER_TURN = np.array([[1.0], [-1.0]])


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
        by_pose: Derivative of the predicted place along the normal by (omega, tau), shape (6, n).
        normal: Unit vectors along the edges' normals in the picture, towards white, (2, n).
        contrast: Grey step from black to white, negative where the picture contradicts, (n,).
        visible: Whole profile inside the picture, shape (n,).
        by_row_way: Derivative of the predicted place along the normal by the way per row, (2, n).
        gain: Derivative of the offset by a shift of the edge: 1 where the profile holds all of
            the edge, less where blur or motion carry it beyond the ends, shape (n,).
        variance_px2: Second central moment of the gradient: the edge's blur squared, shape (n,).
        black: Grey value at the black end of the profile, shape (n,).
        white: The same at the white end.
    """

    offset_px: Array
    by_pose: Array
    normal: Array
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
    rows = seen.u_v[1] - picture.middle_row
    pixels = seen.u_v if row_way is None else seen.u_v + rows * row_way[:, None]
    to_white = seen.along(T_camera_label[:3, :2] @ edges.normals.T)
    along = seen.along(T_camera_label[:3, :2] @ edges.tangents.T)
    normal = along[::-1] * _QUARTER_TURN
    normal /= np.sqrt(normal[0] ** 2 + normal[1] ** 2)
    across = normal[0] * to_white[0] + normal[1] * to_white[1]  # label mm -> px
    normal *= np.sign(across)
    across = np.abs(across)

    half_module = across * (edges.module_mm * REACH_MODULES)
    reach = np.clip(half_module - np.abs(spread_px), 1.0, reach_px)
    longest = float(np.max(reach, initial=2.0))
    # Steps of a pixel, but of half a pixel across the short profiles of sharp edges.
    half_steps = min(math.ceil(max(longest, min(2 * longest, 6.0))), _MOST_HALF_STEPS)
    sampling = _sampling(half_steps)
    middle = pixels - picture.left_top_px[:, None] + normal * spread_px
    forward = normal * reach
    beside = along * edges.length_mm
    extent = np.abs(forward) * sampling.steps[-1] + np.abs(beside) / 3
    last = np.array(picture.light.shape[::-1])[:, None] - 1
    inside = (middle >= extent) & (middle + extent <= last)
    visible = inside[0] & inside[1]
    grey = _profiles(picture.light, middle, beside, forward, sampling)
    if inverted:
        grey = 255 - grey
    black, white = grey[1].astype(np.float64), grey[-2].astype(np.float64)
    if levels is not None:
        grey = _levelled(grey, levels, spread_px / across, reach / across, sampling.steps)

    gradient = grey[1:] - grey[:-1]
    contrast, first, second = (sampling.moments @ gradient).astype(np.float64)
    safe = np.where(contrast > 0, contrast, 1.0)
    share = first / safe
    centroid = share * reach
    variance = (second / safe - share**2) * reach**2
    if expected is not None:
        forward_mm = _in_the_label(forward, to_white, along, edges)
        centroid = centroid - _expected_centroid(expected, edges, forward_mm, sampling) * reach
    offset = np.clip(centroid, -reach, reach) + spread_px
    offset[~visible | (contrast <= 0)] = 0.0
    gain = _gain(gradient, share, safe, half_steps)
    return EdgeOffsets(
        offset_px=offset,
        by_pose=seen.by_pose_along(normal),
        normal=normal,
        contrast=contrast,
        visible=visible,
        by_row_way=normal * rows,
        gain=gain,
        variance_px2=variance,
        black=black,
        white=white,
    )


def _in_the_label(forward: Array, to_white: Array, along: Array, edges: CodeEdges) -> Array:
    """Which ways on the label appear as given ones in the picture, (2, n) [px] -> (n, 2) [mm].

    The ways to white and along an edge, both of a millimetre, span the label.
    """
    area = to_white[0] * along[1] - to_white[1] * along[0]
    white_mm = (forward[0] * along[1] - forward[1] * along[0]) / area
    along_mm = (to_white[0] * forward[1] - to_white[1] * forward[0]) / area
    ways = edges.normals * white_mm[:, None] + edges.tangents * along_mm[:, None]
    return np.asarray(ways, dtype=np.float64)


def _expected_centroid(
    expected: BlurredCode, edges: CodeEdges, forward_mm: Array, sampling: _Sampling
) -> Array:
    """Centroid of the same profiles of the blurred code on -1..1, shape (n,)."""
    vectors = np.stack((edges.points_mm, edges.tangents * edges.length_mm, forward_mm))
    places = sampling.places @ vectors.transpose(2, 0, 1)
    white = expected.at(places).reshape(len(_LINES), -1, len(forward_mm)).mean(axis=0)
    contrast, first, _ = sampling.moments @ (white[1:] - white[:-1])
    safe = np.where(contrast > 0, contrast, np.inf)
    return np.asarray(np.clip(first / safe, -1, 1), dtype=np.float64)


def _gain(
    gradient: NDArray[np.float32],
    centroid: NDArray[np.float64],
    contrast: NDArray[np.float64],
    half_steps: int,
) -> Array:
    """How much of a shift of the grey values the centroid follows, shape (n,).

    With the gradient g on -1..1, c = int s g ds / int g ds; shifting g by d changes c by
    dc/dd = 1 - (g(1) + g(-1) - c (g(1) - g(-1))) / int g ds. The gradient at the ends is the mean
    of those just inside and just outside; the inner alone is so much larger that steps would go
    too far by a twentieth.
    """
    first, last = (gradient[0] + gradient[1]) / 2, (gradient[-2] + gradient[-1]) / 2
    loss = half_steps * (first + last - centroid * (last - first))
    gain = np.clip(1 - loss / contrast, _LEAST_GAIN, _MOST_GAIN)
    return np.asarray(gain, dtype=np.float64)


def _levelled(
    grey: NDArray[np.float32],
    levels: ProfileLevels,
    spread_mm: Array,
    reach_mm: Array,
    steps: NDArray[np.float32],
) -> NDArray[np.float32]:
    """Profiles relative to the local black (0) and white (1), shape (steps, n)."""
    black = levels.black + levels.black_per_mm * spread_mm
    contrast = levels.contrast + levels.contrast_per_mm * spread_mm
    along = steps[:, None]
    lifted = grey - black.astype(np.float32)
    lifted -= (levels.black_per_mm * reach_mm).astype(np.float32) * along
    slope = (levels.contrast_per_mm * reach_mm).astype(np.float32)
    lifted /= contrast.astype(np.float32) + slope * along
    return lifted


class _Sampling(NamedTuple):
    """Where profiles are sampled, and what is made of their gradients.

    Attributes:
        steps: Along the normal, -1 to 1 and one more beyond each end, shape (s,).
        places: Shares of (middle, beside, forward) in every sample's place, line by line and step
            by step, shape (lines s, 3).
        moments: Turn gradients between steps into their sum, first and second moment on -1 to 1,
            shape (3, s - 1).
    """

    steps: NDArray[np.float32]
    places: NDArray[np.float32]
    moments: NDArray[np.float32]


@lru_cache(maxsize=2 * _MOST_HALF_STEPS)
def _sampling(half_steps: int) -> _Sampling:
    steps = (np.arange(-half_steps - 1, half_steps + 2) / half_steps).astype(np.float32)
    lines, along = np.meshgrid(_LINES, steps, indexing="ij")
    places = np.column_stack((np.ones(lines.size), lines.ravel(), along.ravel()))
    middles = (steps[:-1] + steps[1:]) / 2
    moments = np.stack((np.ones_like(middles), middles, middles**2))
    moments[:, [0, -1]] = 0.0  # beyond the ends
    return _Sampling(steps, places.astype(np.float32), moments.astype(np.float32))


def _profiles(
    light: NDArray[np.float32], middle: Array, beside: Array, forward: Array, sampling: _Sampling
) -> NDArray[np.float32]:
    """Light along each edge's normal, the mean of a few lines side by side, (steps, n)."""
    vectors = np.stack((middle, beside, forward), axis=1).astype(np.float32)
    map_x, map_y = sampling.places @ vectors
    seen = cv2.remap(light, map_x, map_y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    lines = np.asarray(seen, dtype=np.float32).reshape(len(_LINES), -1, middle.shape[1])
    total = lines[0] + lines[1]
    total += lines[2]
    total *= np.float32(1 / 3)
    return np.asarray(total, dtype=np.float32)
