"""Viewing rays of all pixels of a distorting camera, quickly and in little memory."""

from __future__ import annotations

from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel

STRIDE_PX = 4
"""Distance of the nodes: linear interpolation of the distortion is then good to 2e-4 px."""


class Region(NamedTuple):
    """A rectangle of pixels; right and bottom are one past the last."""

    left: int
    top: int
    right: int
    bottom: int


class RayGrid:
    """Normalised coordinates (x, y, 1) of pixels.

    Only the difference to a pinhole camera is stored, at every fourth pixel: it is smooth.
    """

    def __init__(self, optics: CameraModel) -> None:
        self._optics = optics
        u = np.arange(-STRIDE_PX, optics.width + 2 * STRIDE_PX, STRIDE_PX, dtype=np.float64)
        v = np.arange(-STRIDE_PX, optics.height + 2 * STRIDE_PX, STRIDE_PX, dtype=np.float64)
        pixels = np.stack(np.meshgrid(u, v), axis=-1)
        criteria = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, 40, 1e-12)
        rays = cv2.undistortPoints(
            pixels.reshape(-1, 1, 2), optics.matrix, optics.distortion, criteria=criteria
        ).reshape(pixels.shape)
        pinhole = (pixels - (optics.cx, optics.cy)) / (optics.fx, optics.fy)
        self._difference = (rays - pinhole).astype(np.float32)

    def rays(self, region: Region) -> NDArray[np.float32]:
        """Rays of a region inside the picture, shape (rows, columns, 2)."""
        optics = self._optics
        rows, columns = region.bottom - region.top, region.right - region.left
        # Nodes start one stride outside; an affine map with integer fractions of the stride.
        to_nodes = np.array(
            [
                [1 / STRIDE_PX, 0.0, region.left / STRIDE_PX + 1],
                [0.0, 1 / STRIDE_PX, region.top / STRIDE_PX + 1],
            ]
        )
        rays = np.asarray(
            cv2.warpAffine(
                self._difference,
                to_nodes,
                (columns, rows),
                flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP,
                borderMode=cv2.BORDER_REPLICATE,
            ),
            dtype=np.float32,
        )
        u = (np.arange(region.left, region.right) - optics.cx) / optics.fx
        v = (np.arange(region.top, region.bottom) - optics.cy) / optics.fy
        rays[..., 0] += u.astype(np.float32)
        rays[..., 1] += v.astype(np.float32)[:, None]
        return rays

    def coarse(self, stride_px: int) -> NDArray[np.float32]:
        """Rays of pixels 0, stride, 2 stride ... beyond the far borders, shape (m, n, 2)."""
        step = stride_px // STRIDE_PX
        rays = self._difference[1::step, 1::step].copy()
        u = (np.arange(rays.shape[1]) * stride_px - self._optics.cx) / self._optics.fx
        v = (np.arange(rays.shape[0]) * stride_px - self._optics.cy) / self._optics.fy
        rays[..., 0] += u.astype(np.float32)
        rays[..., 1] += v.astype(np.float32)[:, None]
        return rays
