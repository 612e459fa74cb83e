"""The optics that the simulated camera has unless told otherwise."""

from __future__ import annotations

import math

from drivers.camera import CameraModel


def default_optics() -> CameraModel:
    """Raspberry Pi camera v2 at 1640 x 1232 px: 62.2 degrees wide, slightly distorting."""
    width, height = 1640, 1232
    focal_px = width / 2 / math.tan(math.radians(62.2 / 2))
    return CameraModel(
        width=width,
        height=height,
        fx=focal_px,
        fy=focal_px,
        cx=(width - 1) / 2 + 3.2,
        cy=(height - 1) / 2 - 2.1,
        k1=-0.03,
        k2=0.02,
        p1=1e-4,
        p2=-1e-4,
    )
