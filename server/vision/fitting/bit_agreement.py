"""Do the modules seen in the picture agree with the code at a given pose?"""

from __future__ import annotations

from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.vision.projection import Array, project

_NEIGHBOURHOOD_MODULES = 9


def bit_agreement(
    image: NDArray[np.uint8],
    camera: CameraModel,
    modules: NDArray[np.bool_],
    T_camera_label: Array,
    label_size_mm: float,
) -> float:
    """Share of modules whose grey value is on the right side of its surroundings' middle.

    A fit that slipped by a module has small residuals but agrees in little more than half of
    the modules. An inverted code (white on black) gives a value near 0.

    Args:
        image: Grey values, shape (height, width).
        camera: Intrinsics and distortion.
        modules: True is black, shape (n, n).
        T_camera_label: Pose to test, shape (4, 4) [mm].
        label_size_mm: Outer side of the code without its quiet zone.

    Returns:
        0 to 1.
    """
    count = modules.shape[0]
    pixels = project(camera, T_camera_label, _middles(count) * label_size_mm).pixels
    map_x, map_y = pixels.T.astype(np.float32).reshape(2, count + 2, count + 2)
    grey = cv2.remap(image, map_x, map_y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    window = np.ones((_NEIGHBOURHOOD_MODULES, _NEIGHBOURHOOD_MODULES), dtype=np.uint8)
    middle = (cv2.erode(grey, window).astype(np.float32) + cv2.dilate(grey, window)) / 2
    black = np.asarray(grey < middle)[1:-1, 1:-1]
    return float(np.mean(black == modules))


@lru_cache(maxsize=8)
def _middles(count: int) -> Array:
    """Middles of all modules of a code of side 1, row by row, shape ((count + 2)^2, 2).

    One row of the quiet zone all around joins in, so that border modules have surroundings.
    """
    middles = (np.arange(-1, count + 1) + 0.5) / count - 0.5
    x, y = np.meshgrid(middles, middles)
    places = np.column_stack((x.ravel(), y.ravel()))
    places.flags.writeable = False  # it is shared through the cache
    return places
