"""The calibration that the configuration has chosen."""

from __future__ import annotations

from server.config.settings import Settings
from server.vision.camera_file import load_camera_file


def with_camera_calibration(settings: Settings) -> Settings:
    """The settings with the camera model of ``camera.calibration``, if one is chosen.

    Raises:
        InvalidCameraFileError: the file cannot be used.
    """
    path = settings.camera.calibration
    if path is None:
        return settings
    camera = settings.camera.model_copy(update={"optics": load_camera_file(path)})
    return settings.model_copy(update={"camera": camera})
