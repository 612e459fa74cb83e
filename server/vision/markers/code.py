"""One code found in a picture, whatever kind of marker it is."""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

Image = NDArray[np.uint8]


@dataclass(frozen=True, slots=True, eq=False)
class Code:
    """A square of black and white modules, read but not yet located.

    Attributes:
        payload: Its text, exactly as encoded; of a tag, its family and number.
        corners_px: Outer corners of the code without quiet zone in the order top left, top right,
            bottom right, bottom left of the code itself, shape (4, 2) [px], pixel centres at
            integers; good to about 1 px.
        modules: What its modules are, as well as it is known, True is black, shape (n, n).
        mirrored: The code is seen in a mirror.
    """

    payload: str
    corners_px: NDArray[np.float64]
    modules: NDArray[np.bool_]
    mirrored: bool = False

    @property
    def area_px(self) -> float:
        """Area of the quadrilateral of the corners [px^2]."""
        return abs(float(cv2.contourArea(self.corners_px.astype(np.float32))))

    def enlarged(self, scale: float, shift_px: tuple[float, float]) -> Code:
        """The code as seen in a picture of which this one's was a scaled part."""
        corners = (self.corners_px + 0.5) / scale - 0.5 + np.array(shift_px)
        return replace(self, corners_px=corners)

    def is_same_place(self, other: Code) -> bool:
        """Whether both are sightings of one and the same code."""
        apart = np.linalg.norm(self.corners_px.mean(axis=0) - other.corners_px.mean(axis=0))
        return bool(apart < 0.5 * np.sqrt(min(self.area_px, other.area_px)))
