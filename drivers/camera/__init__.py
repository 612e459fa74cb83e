"""Cameras: the protocol every camera driver follows, and the model of its optics."""

from drivers.camera.errors import CameraError, CameraTimeoutError
from drivers.camera.model import CameraModel
from drivers.camera.pi_camera import pi_camera_v2
from drivers.camera.protocol import CameraDriver, Frame

__all__ = [
    "CameraDriver",
    "CameraError",
    "CameraModel",
    "CameraTimeoutError",
    "Frame",
    "pi_camera_v2",
]
