"""Pictures in files."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from server.vision.errors import ImageUnreadableError


def load_grey_image(path: Path) -> NDArray[np.uint8]:
    """Read a picture as the sensor gave it: an orientation note in the file is not followed.

    Returns:
        Grey values, shape (height, width).

    Raises:
        ImageUnreadableError: the file is missing, not readable or not a picture.
    """
    try:
        content = path.read_bytes()
    except OSError as error:
        detail = f"The picture {path} cannot be read: {error.strerror or error}."
        raise ImageUnreadableError(detail) from error
    flags = cv2.IMREAD_GRAYSCALE | cv2.IMREAD_IGNORE_ORIENTATION
    try:
        image = cv2.imdecode(np.frombuffer(content, dtype=np.uint8), flags) if content else None
    except cv2.error:  # some damaged files make the decoder throw instead of returning nothing
        image = None
    if image is None:
        detail = f"The file {path} is not a picture, or is damaged."
        raise ImageUnreadableError(detail)
    return np.asarray(image, dtype=np.uint8)
