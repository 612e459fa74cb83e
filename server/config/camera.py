"""Which camera looks at the socket, through which optics, from where."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from drivers.camera import CameraModel, pi_camera_v2
from server.config.section import Section
from twin.camera_mount import CameraMount


class CameraSettings(Section):
    """The camera on the platform."""

    driver: Literal["simulator"] = Field(
        "simulator", description="Kind of camera; a simulated one goes with a real robot, too"
    )
    optics: CameraModel = Field(default_factory=pi_camera_v2)
    mount: CameraMount = CameraMount()
