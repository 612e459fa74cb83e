"""Smooth things are worked out at every sixteenth pixel and enlarged."""

from __future__ import annotations

import math

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel

Field = NDArray[np.float32]


class CoarseGrid:
    """Nodes all over the picture and one beyond each border.

    They lie in the middle of squares of pixels, where ``cv2.resize`` expects them, which is ten
    times as fast as a general affine map.

    Args:
        optics: The camera.
        stride_px: Distance of the nodes.
    """

    def __init__(self, optics: CameraModel, stride_px: int) -> None:
        self._stride_px = stride_px
        self._size = (optics.height, optics.width)
        u = self._places(optics.width)
        v = self._places(optics.height)
        pixels = np.stack(np.meshgrid(u, v), axis=-1)
        criteria = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, 40, 1e-12)
        rays = cv2.undistortPoints(
            pixels.reshape(-1, 1, 2), optics.matrix, optics.distortion, criteria=criteria
        )
        self.u_px, self.v_px = u, v
        self.rays = rays.reshape(pixels.shape)
        """Normalised coordinates (x, y) of the nodes, shape (m, n, 2)."""

    def _places(self, length: int) -> NDArray[np.float64]:
        nodes = math.ceil(length / self._stride_px) + 2
        return np.asarray((np.arange(nodes) - 0.5) * self._stride_px - 0.5, dtype=np.float64)

    def enlarged(self, field: Field) -> Field:
        """Linear interpolation of a field on the nodes, shape (m, n), to all pixels."""
        height, width = self._size
        return self.enlarged_part(field, (0, 0, width, height))

    def enlarged_part(self, field: Field, part: tuple[int, int, int, int]) -> Field:
        """The same for the pixels from left, top to right, bottom (one past the last)."""
        stride = self._stride_px
        left, top, right, bottom = part
        columns = slice(left // stride, (right - 1) // stride + 3)
        rows = slice(top // stride, (bottom - 1) // stride + 3)
        nodes = np.ascontiguousarray(field[rows, columns])
        size = (nodes.shape[1] * stride, nodes.shape[0] * stride)
        large = cv2.resize(nodes, size, interpolation=cv2.INTER_LINEAR)
        across, down = left % stride + stride, top % stride + stride
        return np.asarray(
            large[down : down + bottom - top, across : across + right - left], dtype=np.float32
        )
