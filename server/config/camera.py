"""Which camera looks at the socket, through which optics, from where."""

from __future__ import annotations

import math
from typing import Literal

from pydantic import Field

from drivers.camera import CameraModel
from server.config.section import Section
from twin.camera_mount import CameraMount


def nominal_optics() -> CameraModel:
    """Raspberry Pi camera v2 at 1640 x 1232: 62.2 deg of horizontal view, mild distortion.

    A calibration of the camera at hand replaces these numbers.
    """
    focal_px = 820 / math.tan(math.radians(62.2 / 2))
    return CameraModel(
        width=1640,
        height=1232,
        fx=focal_px,
        fy=focal_px,
        cx=819.5,
        cy=615.5,
        k1=-0.03,
        k2=0.02,
        p1=1e-4,
        p2=1e-4,
        k3=0.0,
    )


class CameraSettings(Section):
    """The camera on the platform."""

    driver: Literal["simulator"] = Field("simulator", description="Kind of camera")
    optics: CameraModel = Field(default_factory=nominal_optics)
    mount: CameraMount = CameraMount()
