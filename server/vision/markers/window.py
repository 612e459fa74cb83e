"""The part of a picture in which a code is expected."""

from __future__ import annotations

from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from server.vision.markers.code import Image

MARGIN = 0.25
"""Of the code's size, on every side: the quiet zone and some room for a wrong expectation."""

_SIDE_PX = 220.0  # the code is brought to this size: about 8 px per module of a usual label
_LEAST_SCALE, _MOST_SCALE = 0.25, 4.0


class Window(NamedTuple):
    """A scaled part of a picture.

    Attributes:
        image: Grey values.
        scale: Its pixels per pixel of the picture.
        left_top_px: Its first pixel in the picture.
    """

    image: Image
    scale: float
    left_top_px: tuple[float, float]


def window_around(image: Image, corners_px: NDArray[np.float64]) -> Window | None:
    """Cut out the surroundings of corners, shape (4, 2); None if they are not in the picture."""
    low, high = corners_px.min(axis=0), corners_px.max(axis=0)
    side = float(np.max(high - low))
    limit = np.array((image.shape[1], image.shape[0]))
    left, top = np.clip(np.floor(low - MARGIN * side), 0, limit).astype(int)
    right, bottom = np.clip(np.ceil(high + MARGIN * side), 0, limit).astype(int)
    if right - left < 8 or bottom - top < 8:
        return None
    part = image[top:bottom, left:right]
    scale = float(np.clip(_SIDE_PX / side, _LEAST_SCALE, _MOST_SCALE))
    if 0.8 < scale < 1.25:
        return Window(part, 1.0, (float(left), float(top)))
    method = cv2.INTER_AREA if scale < 1 else cv2.INTER_CUBIC
    resized = cv2.resize(part, None, fx=scale, fy=scale, interpolation=method)
    return Window(np.asarray(resized, dtype=np.uint8), scale, (float(left), float(top)))
