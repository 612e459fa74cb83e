"""Viewing rays of all pixels of a distorting camera."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from drivers.simulator.camera.coarse_grid import CoarseGrid

STRIDE_PX = 4
"""Distance of the nodes: linear interpolation of the distortion is then good to 2e-4 px."""


class Region(NamedTuple):
    """A rectangle of pixels; right and bottom are one past the last."""

    left: int
    top: int
    right: int
    bottom: int


class RayGrid:
    """Normalised coordinates (x, y) of all pixels; the ray is (x, y, 1).

    Distortion is smooth: it is worked out at every fourth pixel and interpolated, pinhole aside.
    """

    def __init__(self, optics: CameraModel) -> None:
        self.optics = optics
        nodes = CoarseGrid(optics, STRIDE_PX)
        u = (np.arange(optics.width) - optics.cx) / optics.fx
        v = (np.arange(optics.height) - optics.cy) / optics.fy
        self._rays = np.empty((optics.height, optics.width, 2), dtype=np.float32)
        for axis, (places, centre, focal) in enumerate(
            ((nodes.u_px, optics.cx, optics.fx), (nodes.v_px[:, None], optics.cy, optics.fy))
        ):
            difference = nodes.rays[..., axis] - (places - centre) / focal
            self._rays[..., axis] = nodes.enlarged(difference.astype(np.float32))
        self._rays[..., 0] += u.astype(np.float32)
        self._rays[..., 1] += v.astype(np.float32)[:, None]

    def rays(self, region: Region) -> NDArray[np.float32]:
        """Rays of a region inside the picture, shape (rows, columns, 2)."""
        return self._rays[region.top : region.bottom, region.left : region.right]
