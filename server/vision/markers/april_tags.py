"""AprilTags of the family 36h11 as markers (Olson 2011; found by OpenCV)."""

from __future__ import annotations

import re
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from server.vision.markers.code import Code, Image
from server.vision.markers.window import window_around

FAMILY = "tag36h11"
_PAYLOAD = re.compile(rf"{FAMILY}:(0|[1-9][0-9]{{0,2}})")


@lru_cache(maxsize=1)
def _dictionary() -> cv2.aruco.Dictionary:
    return cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_APRILTAG_36h11)


@lru_cache(maxsize=16)
def tag_modules(payload: str) -> NDArray[np.bool_]:
    """Modules of a tag with its black frame, True is black, shape (8, 8), read-only.

    Args:
        payload: Family and number, such as "tag36h11:17".

    Raises:
        ValueError: there is no such tag.
    """
    match = _PAYLOAD.fullmatch(payload)
    dictionary = _dictionary()
    if match is None or int(match[1]) >= len(dictionary.bytesList):
        message = f"{payload!r} is no tag: give {FAMILY}:0 to {FAMILY}:586"
        raise ValueError(message)
    side = dictionary.markerSize + 2
    picture = dictionary.generateImageMarker(int(match[1]), side)
    modules: NDArray[np.bool_] = np.asarray(picture) == 0
    modules.flags.writeable = False  # it is shared through the cache
    return modules


class AprilTags:
    """Finds tags; satisfies ``Marker``. Mirrored tags are no tags, so they are not found."""

    def __init__(self) -> None:
        parameters = cv2.aruco.DetectorParameters()
        parameters.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_NONE  # the edge fit does it
        parameters.detectInvertedMarker = True
        self._detector = cv2.aruco.ArucoDetector(_dictionary(), parameters)

    def find(self, image: Image, *, wanted: str | None = None) -> list[Code]:
        """Tags in a picture, largest first."""
        del wanted  # there is only one way to look
        corners, numbers, _ = self._detector.detectMarkers(image)
        # Without a tag the numbers are None in some versions of OpenCV, and empty in others.
        found = [
            _code(int(number), np.asarray(quad, dtype=np.float64))
            for number, quad in zip(np.ravel(numbers if corners else ()), corners, strict=True)
        ]
        return sorted(found, key=lambda code: -code.area_px)

    def find_near(self, image: Image, corners_px: NDArray[np.float64], wanted: str) -> Code | None:
        """The wanted tag near where it is expected."""
        window = window_around(image, corners_px)
        if window is None:
            return None
        for code in self.find(window.image):
            if code.payload == wanted:
                return code.enlarged(window.scale, window.left_top_px)
        return None


def _code(number: int, quad: NDArray[np.float64]) -> Code:
    """Corners are the centres of the outermost black pixels: half a pixel inside the edge."""
    payload = f"{FAMILY}:{number}"
    corners = quad.reshape(4, 2)
    outwards = corners - corners.mean(axis=0)
    outwards /= np.maximum(np.abs(outwards), 1e-9)
    return Code(payload, corners + 0.5 * outwards, tag_modules(payload))
