"""The light that fell on the sensor around a label, from the grey values of a picture.

Lens, focus and motion blur the light, and the camera's tone curve comes afterwards. In grey
values a blurred edge is lopsided, and its centroid moves with everything that is blurred into it;
in light it is not.
"""

from __future__ import annotations

from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.vision.fitting.code_edges import CodeEdges
from server.vision.fitting.start_pose import corners_mm
from server.vision.projection import Array, project

_MARGIN_SHARE = 0.12  # of the label's side in the picture: the quiet zone
_MARGIN_PX = 24.0


class LightPicture(NamedTuple):
    """A part of a picture, linear in the light.

    Attributes:
        light: 0 (black) to 255 (white), shape (height, width) of the part.
        left_top_px: Its first pixel in the whole picture, shape (2,).
        middle_row: Middle of the whole picture.
    """

    light: NDArray[np.float32]
    left_top_px: NDArray[np.intp]
    middle_row: float


def light_around(
    image: NDArray[np.uint8], camera: CameraModel, T_camera_label: Array, edges: CodeEdges
) -> LightPicture:
    """The light around where a pose, shape (4, 4) [mm], has the label; all of it if it is behind.

    Args:
        image: Grey values, shape (height, width).
        camera: Intrinsics and distortion.
        T_camera_label: Roughly where the label is.
        edges: Edges of the code, whose extent counts.
    """
    height, width = image.shape
    left, top, right, bottom = 0, 0, width, height
    corners = corners_mm(2 * float(np.abs(edges.points_mm).max()))
    in_front = (corners @ T_camera_label[2, :3] + T_camera_label[2, 3]).min() > 0
    if in_front:
        pixels = project(camera, T_camera_label, corners).pixels
        low, high = pixels.min(axis=0), pixels.max(axis=0)
        margin = _MARGIN_SHARE * float(np.max(high - low)) + _MARGIN_PX
        left, top = np.clip(np.floor(low - margin), 0, (width - 1, height - 1)).astype(int)
        right, bottom = np.clip(np.ceil(high + margin), 1, (width, height)).astype(int)
    part = image[top : max(bottom, top + 1), left : max(right, left + 1)]
    light = np.asarray(cv2.LUT(part, _LIGHT), dtype=np.float32)
    return LightPicture(light, np.array((left, top), dtype=np.intp), (height - 1) / 2)


def _tone_curve() -> NDArray[np.float32]:
    """Light of each grey value, as IEC 61966-2-1 (sRGB) has it, 0 to 255."""
    grey = np.arange(256) / 255
    light = np.where(grey <= 0.04045, grey / 12.92, ((grey + 0.055) / 1.055) ** 2.4)
    return np.asarray(255 * light, dtype=np.float32)


_LIGHT = _tone_curve()
