"""Which camera looks at the socket, through which optics, from where."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from pydantic import Field

from drivers.camera import CameraModel, pi_camera_v2
from drivers.camera.settings import CameraLinks
from server.config.section import Section
from twin.camera_mount import CameraMount


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
