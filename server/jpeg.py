"""Grey pictures as JPEG, as pages and recordings take them."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray


def as_jpeg(image: NDArray[np.uint8], *, quality: int, most_width_px: int | None = None) -> bytes:
    """A picture as JPEG.

    Args:
        image: Grey values, shape (height, width).
        quality: Of the JPEG, 0 to 100.
        most_width_px: A wider picture is made smaller first; None: none is.
    """
    height, width = image.shape
    if most_width_px is not None and width > most_width_px:
        size = (most_width_px, round(height * most_width_px / width))
        image = np.asarray(cv2.resize(image, size, interpolation=cv2.INTER_AREA), np.uint8)
    _, encoded = cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, quality])
    return encoded.tobytes()
