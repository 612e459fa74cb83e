"""What is known of the camera, and how well."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

from drivers.camera import CameraModel
from server.config.camera import CameraDoubt, CameraSettings
from twin.camera_mount import CameraMount


@dataclass(frozen=True, slots=True)
class KnownCamera:
    """The camera as far as known.

    Attributes:
        optics: Its model.
        mount: Where it sits on the platform.
        doubt: How far the built one may be from both.
    """

    optics: CameraModel
    mount: CameraMount
    doubt: CameraDoubt

    @classmethod
    def configured(cls, settings: CameraSettings) -> Self:
        """What the configuration says, without any calibration."""
        return cls(settings.optics, settings.mount, settings.doubt)
