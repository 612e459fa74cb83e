"""The camera the robot is designed with, as its data sheet describes it."""

from __future__ import annotations

import math

from drivers.camera.model import CameraModel

WIDTH_PX, HEIGHT_PX = 1640, 1232
HORIZONTAL_VIEW_RAD = math.radians(62.2)


def pi_camera_v2() -> CameraModel:
    """Raspberry Pi camera v2 at 1640 x 1232 px, its full field: 62.2 degrees, mild distortion.

    A calibration of the camera at hand replaces these numbers.
    """
    focal_px = WIDTH_PX / 2 / math.tan(HORIZONTAL_VIEW_RAD / 2)
    return CameraModel(
        width=WIDTH_PX,
        height=HEIGHT_PX,
        fx=focal_px,
        fy=focal_px,
        cx=(WIDTH_PX - 1) / 2,
        cy=(HEIGHT_PX - 1) / 2,
        k1=-0.03,
        k2=0.02,
        p1=1e-4,
        p2=1e-4,
    )
