"""Pinhole camera with the radial and tangential distortion of OpenCV."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field

Finite = Annotated[float, Field(allow_inf_nan=False)]


class CameraModel(BaseModel):
    """Intrinsics of one camera at one resolution.

    A point (x, y, 1) in the camera frame (x right, y down, z forward) appears at
    u = fx x_d + cx, v = fy y_d + cy with r^2 = x^2 + y^2 and
    x_d = x (1 + k1 r^2 + k2 r^4 + k3 r^6) + 2 p1 x y + p2 (r^2 + 2 x^2),
    y_d = y (1 + k1 r^2 + k2 r^4 + k3 r^6) + p1 (r^2 + 2 y^2) + 2 p2 x y.
    Pixel centres are at integer coordinates: (0, 0) is the centre of the top left pixel.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    width: int = Field(gt=0, le=16_384, description="[px]")
    height: int = Field(gt=0, le=16_384, description="[px]")
    fx: float = Field(gt=0, allow_inf_nan=False, description="[px]")
    fy: float = Field(gt=0, allow_inf_nan=False, description="[px]")
    cx: Finite = Field(description="[px]")
    cy: Finite = Field(description="[px]")
    k1: Finite = 0.0
    k2: Finite = 0.0
    p1: Finite = 0.0
    p2: Finite = 0.0
    k3: Finite = 0.0

    @property
    def matrix(self) -> NDArray[np.float64]:
        """Camera matrix K, shape (3, 3) [px]."""
        return np.array([[self.fx, 0.0, self.cx], [0.0, self.fy, self.cy], [0.0, 0.0, 1.0]])

    @property
    def distortion(self) -> NDArray[np.float64]:
        """Coefficients k1 k2 p1 p2 k3 in OpenCV's order, shape (5,)."""
        return np.array([self.k1, self.k2, self.p1, self.p2, self.k3])
