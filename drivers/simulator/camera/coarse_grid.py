"""What changes smoothly from pixel to pixel is worked out at a few of them and enlarged."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel

Field = NDArray[np.float32]

_MOST_ROUNDS = 60
_CLOSE_PX = 1e-7


class Region(NamedTuple):
    """A rectangle of pixels; right and bottom are one past the last."""

    left: int
    top: int
    right: int
    bottom: int


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
        self.optics = optics
        u = self._places(optics.width)
        v = self._places(optics.height)
        pixels = np.stack(np.meshgrid(u, v), axis=-1)
        self.u_px, self.v_px = u, v
        self.rays = _rays(optics, pixels.reshape(-1, 2)).reshape(pixels.shape)
        self.rays.flags.writeable = False
        """Normalised coordinates (x, y) of the nodes, shape (m, n, 2)."""

    def _places(self, length: int) -> NDArray[np.float64]:
        nodes = math.ceil(length / self._stride_px) + 2
        return np.asarray((np.arange(nodes) - 0.5) * self._stride_px - 0.5, dtype=np.float64)

    def enlarged(self, field: Field) -> Field:
        """Linear interpolation of a field on the nodes, shape (m, n), to all pixels."""
        whole = Region(0, 0, self.optics.width, self.optics.height)
        return self.enlarged_part(field[self.around(whole)], whole)

    def around(self, part: Region) -> tuple[slice, slice]:
        """Rows and columns of the nodes that ``enlarged_part`` needs."""
        stride = self._stride_px
        rows = slice(part.top // stride, (part.bottom - 1) // stride + 3)
        columns = slice(part.left // stride, (part.right - 1) // stride + 3)
        return rows, columns

    def enlarged_part(self, nodes: Field, part: Region) -> Field:
        """Linear interpolation of the nodes around a part of the picture to its pixels."""
        stride = self._stride_px
        size = (nodes.shape[1] * stride, nodes.shape[0] * stride)
        large = cv2.resize(np.ascontiguousarray(nodes), size, interpolation=cv2.INTER_LINEAR)
        across, down = part.left % stride + stride, part.top % stride + stride
        inside = np.s_[
            down : down + part.bottom - part.top, across : across + part.right - part.left
        ]
        return np.asarray(large[inside], dtype=np.float32)


@lru_cache(maxsize=2)
def coarse_grid(optics: CameraModel, stride_px: int) -> CoarseGrid:
    """A grid, shared by all who need the same one; a camera that opens again finds its rays."""
    return CoarseGrid(optics, stride_px)


def _rays(optics: CameraModel, pixels: NDArray[np.float64]) -> NDArray[np.float64]:
    """Normalised coordinates of pixels, both shape (n, 2), exact to a millionth of a pixel.

    What a ray misses its pixel by is taken off the ray, again and again. OpenCV's own function
    stops after five rounds; how to ask for more differs between its versions 4 and 5.
    """
    wanted = (pixels - (optics.cx, optics.cy)) / (optics.fx, optics.fy)
    rays = wanted.copy()
    for _ in range(_MOST_ROUNDS):
        missed = _distorted(optics, rays) - wanted
        rays -= missed
        if np.abs(missed).max() * optics.fx < _CLOSE_PX:
            break
    return rays


def _distorted(optics: CameraModel, rays: NDArray[np.float64]) -> NDArray[np.float64]:
    """What the lens makes of rays (x, y): radial and tangential distortion (Brown 1966)."""
    x, y = rays[:, 0], rays[:, 1]
    square = x * x + y * y
    radial = 1 + square * (optics.k1 + square * (optics.k2 + square * optics.k3))
    twice_xy = 2 * x * y
    return np.column_stack(
        (
            x * radial + optics.p1 * twice_xy + optics.p2 * (square + 2 * x * x),
            y * radial + optics.p1 * (square + 2 * y * y) + optics.p2 * twice_xy,
        )
    )
