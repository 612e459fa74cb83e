"""A code as blur lets it appear, in label coordinates."""

from __future__ import annotations

from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from server.vision.projection import Array


class BlurredCode(NamedTuple):
    """The blurred code in label coordinates.

    Attributes:
        white: 0 (black) to 1 (white), shape (m, m).
        middle: Column and row of the label's origin.
        per_mm: NDArray[np.float32] per millimetre.
    """

    white: NDArray[np.float32]
    middle: float
    per_mm: float

    def at(self, points_mm: Array) -> NDArray[np.float32]:
        """Values at label coordinates x and y, shape (2, k, n) -> (k, n)."""
        places = (points_mm * self.per_mm + self.middle).astype(np.float32)
        seen = cv2.remap(
            self.white,
            places[0],
            places[1],
            cv2.INTER_CUBIC,
            borderMode=cv2.BORDER_REPLICATE,
        )
        return np.asarray(seen, dtype=np.float32)
