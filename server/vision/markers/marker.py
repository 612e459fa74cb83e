"""What the locator needs to know about a kind of marker."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from server.vision.markers.code import Code, Image


class Marker(Protocol):
    """A kind of marker: a square of black and white modules with white around it."""

    def find(self, image: Image, *, wanted: str | None = None) -> list[Code]:
        """Codes of this kind in a picture, largest first.

        Args:
            image: Grey values, shape (height, width).
            wanted: Try hard to find a code with this text; None is content with any.
        """
        ...

    def find_near(self, image: Image, corners_px: NDArray[np.float64], wanted: str) -> Code | None:
        """The code with a text near where its corners are expected; None if it is not there.

        Args:
            image: Grey values, shape (height, width).
            corners_px: Expected corners in the order of Code.corners_px, shape (4, 2).
            wanted: The text.
        """
        ...
