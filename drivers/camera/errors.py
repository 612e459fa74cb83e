"""Errors of cameras.

CameraError
├── CameraMissingError    it cannot be opened, or was unplugged
├── CameraTimeoutError    no new frame in time
├── CameraFrozenError     the same picture comes again and again
├── WrongResolutionError  pictures of another size than the calibration is for
└── PicturesError         there are no pictures to replay, or they cannot be read
"""

from __future__ import annotations

from typing import ClassVar


class CameraError(Exception):
    """The camera cannot deliver; the message says why and what to do."""

    code: ClassVar[str] = "camera"


class CameraMissingError(CameraError):
    """There is no such camera, or it is not there any more."""

    code = "camera_missing"


class CameraTimeoutError(CameraError):
    """No new frame arrived in time."""

    code = "camera_timeout"


class CameraFrozenError(CameraError):
    """The camera delivers, but always the same picture."""

    code = "camera_frozen"


class WrongResolutionError(CameraError):
    """The pictures have another size than the camera's calibration."""

    code = "camera_resolution"


class PicturesError(CameraError):
    """Pictures to replay are missing, empty or damaged."""

    code = "camera_pictures"
