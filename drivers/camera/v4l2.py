"""USB cameras and others that Linux knows (V4L2), through OpenCV."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from typing import Any

import cv2

from drivers.camera.errors import CameraMissingError, WrongResolutionError
from drivers.camera.frame_timing import FrameGaps
from drivers.camera.model import CameraModel
from drivers.camera.settings import V4l2Settings
from drivers.camera.source import RawFrame, grey

_log = logging.getLogger(__name__)

MANUAL_EXPOSURE, AUTOMATIC_EXPOSURE = 1, 3  # V4L2_EXPOSURE_MANUAL, V4L2_EXPOSURE_APERTURE_PRIORITY
EXPOSURE_UNIT_S = 1e-4  # V4L2_CID_EXPOSURE_ABSOLUTE
LONGEST_AGE_S = 2.0
"""An older time stamp is of another clock."""

Opener = Callable[[str | int], Any]


def open_device(device: str | int) -> cv2.VideoCapture:
    """Open a device with the one backend that has its controls."""
    return cv2.VideoCapture(device, cv2.CAP_V4L2)


class V4l2Source:
    """Implements FrameSource.

    Args:
        settings: Which camera, and how it is to see.
        optics: Gives the resolution to ask for.
        opener: Opens a device; OpenCV's by default.
    """

    def __init__(
        self, settings: V4l2Settings, optics: CameraModel, opener: Opener = open_device
    ) -> None:
        self._settings = settings
        self._optics = optics
        self._opener = opener
        self._capture: Any = None
        self._gaps = FrameGaps(settings.frames_per_s)

    @property
    def name(self) -> str:
        """Name a person recognises."""
        return f"Camera {self._settings.device}"

    def open(self) -> None:
        """Open the device and fix its resolution, exposure and focus.

        Raises:
            CameraMissingError: there is no such device, or somebody else uses it.
            WrongResolutionError: it cannot do the calibrated resolution.
        """
        device = self._settings.device
        capture = self._opener(int(device) if device.isdigit() else device)
        if not capture.isOpened():
            capture.release()
            raise CameraMissingError(
                f"{self.name} cannot be opened: check its cable, that no other program uses it, "
                "and that this user is in the group video."
            )
        self._capture = capture
        self._gaps.restart()
        self._choose_mode()
        self._fix_controls()

    def read(self) -> RawFrame:
        """Wait for the next picture.

        Raises:
            CameraMissingError: none comes any more.
        """
        taken, picture = self._capture.read()
        if not taken:
            raise CameraMissingError(f"{self.name} delivers no more pictures: check its cable.")
        captured_s = self._captured_s()
        return RawFrame(
            grey(picture),
            captured_s,
            self._settings.exposure_s or 0.0,
            self._gaps.frames_since_last(captured_s),
        )

    def skip(self) -> int:
        """Wait for the next picture without decoding it.

        Raises:
            CameraMissingError: none comes any more.
        """
        if not self._capture.grab():
            raise CameraMissingError(f"{self.name} delivers no more pictures: check its cable.")
        return self._gaps.frames_since_last(self._captured_s())

    def close(self) -> None:
        """Give the device free."""
        capture, self._capture = self._capture, None
        if capture is not None:
            capture.release()

    def _choose_mode(self) -> None:
        optics, settings = self._optics, self._settings
        for control, value in (
            (cv2.CAP_PROP_FOURCC, cv2.VideoWriter.fourcc(*settings.fourcc)),
            (cv2.CAP_PROP_FRAME_WIDTH, optics.width),
            (cv2.CAP_PROP_FRAME_HEIGHT, optics.height),
            (cv2.CAP_PROP_FPS, settings.frames_per_s),
            (cv2.CAP_PROP_BUFFERSIZE, 1),
        ):
            self._capture.set(control, value)
        width = int(self._capture.get(cv2.CAP_PROP_FRAME_WIDTH))
        height = int(self._capture.get(cv2.CAP_PROP_FRAME_HEIGHT))
        if (width, height) != (optics.width, optics.height):
            raise WrongResolutionError(
                f"{self.name} offers {width} x {height} pixels in place of the calibrated "
                f"{optics.width} x {optics.height}: calibrate it for a mode that it has."
            )

    def _fix_controls(self) -> None:
        settings = self._settings
        if settings.exposure_s is None:
            self._set("automatic exposure", cv2.CAP_PROP_AUTO_EXPOSURE, AUTOMATIC_EXPOSURE)
        else:
            self._set("manual exposure", cv2.CAP_PROP_AUTO_EXPOSURE, MANUAL_EXPOSURE)
            units = round(settings.exposure_s / EXPOSURE_UNIT_S)
            self._set("exposure time", cv2.CAP_PROP_EXPOSURE, max(1, units))
        if settings.gain is not None:
            self._set("gain", cv2.CAP_PROP_GAIN, settings.gain)
        self._set("autofocus off", cv2.CAP_PROP_AUTOFOCUS, 0)
        if settings.focus is not None:
            self._set("focus", cv2.CAP_PROP_FOCUS, settings.focus)

    def _set(self, what: str, control: int, value: float) -> None:
        """Cameras lack controls (a fixed lens needs no focus): said, but no reason to give up."""
        if not self._capture.set(control, value):
            _log.info("%s has no control for: %s", self.name, what)

    def _captured_s(self) -> float:
        """Middle of the exposure. V4L2 stamps pictures on the monotonic clock at their end."""
        now_s = time.monotonic()
        stamp_s = float(self._capture.get(cv2.CAP_PROP_POS_MSEC)) / 1000.0
        end_s = stamp_s if 0.0 <= now_s - stamp_s <= LONGEST_AGE_S else now_s
        return end_s - 0.5 * (self._settings.exposure_s or 0.0)
