"""Cameras: the protocol every camera driver follows, and the model of its optics."""

from drivers.camera.errors import CameraError, CameraTimeoutError
from drivers.camera.model import CameraModel
from drivers.camera.protocol import CameraDriver, Frame

__all__ = ["CameraDriver", "CameraError", "CameraModel", "CameraTimeoutError", "Frame"]
