"""Which camera looks at the socket, through which optics, from where."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Literal

from pydantic import Field

from drivers.camera import CameraModel, pi_camera_v2
from drivers.camera.settings import CameraLinks
from server.config.section import Section
from twin.camera_mount import CameraMount


class CameraDoubt(Section):
    """How far the built camera may be from what is known of it, to either side.

    The defaults are for a robot that nobody has calibrated: two standard deviations of what a
    drill, a printer and a cheap lens leave. A calibration in force takes its part away.
    """

    turn_deg: float = Field(3.0, ge=0, le=15, description="Turned about each of its axes")
    mount_mm: float = Field(5.0, ge=0, le=50, description="Shifted on the platform, each way")
    platform_mm: float = Field(6.0, ge=0, le=50, description="The platform itself, each way")
    focal_share: float = Field(0.01, ge=0, le=0.2, description="Focal length, of the known one")
    centre_px: float = Field(8.0, ge=0, le=200, description="Middle of the picture, each way")

    @property
    def turn_rad(self) -> float:
        """The same turn [rad]."""
        return math.radians(self.turn_deg)


NO_DOUBT = CameraDoubt(turn_deg=0.0, mount_mm=0.0, platform_mm=0.0, focal_share=0.0, centre_px=0.0)
"""A camera that is exactly as it is known to be."""


class CameraSettings(Section):
    """The camera on the platform."""

    driver: Literal["simulator", "v4l2", "picamera", "stream", "replay"] = Field(
        "simulator",
        description="Kind of camera: v4l2 is a USB camera, picamera the Raspberry Pi's, stream one "
        "on the network, replay files; a simulated one goes with a real robot, too",
    )
    link: CameraLinks = CameraLinks()
    optics: CameraModel = Field(default_factory=pi_camera_v2)
    calibration: Path | None = Field(
        None, description="File of `plugpilot calibrate camera`; it replaces optics"
    )
    mount: CameraMount = CameraMount()
    doubt: CameraDoubt = CameraDoubt()
