"""The Raspberry Pi camera through picamera2, which comes with the Raspberry Pi's system."""

from __future__ import annotations

import contextlib
import importlib
import time
from typing import Any

import numpy as np

from drivers.camera.errors import CameraError, CameraMissingError
from drivers.camera.frame_timing import FrameGaps
from drivers.camera.model import CameraModel
from drivers.camera.settings import PiCameraSettings
from drivers.camera.source import RawFrame

NS, US = 1e-9, 1e-6
MANUAL_FOCUS = 0  # libcamera controls.AfModeEnum.Manual


class PiCameraSource:
    """Implements FrameSource.

    Args:
        settings: Which camera, and how it is to see.
        optics: Gives the resolution to ask for.
    """

    def __init__(self, settings: PiCameraSettings, optics: CameraModel) -> None:
        self._settings = settings
        self._optics = optics
        self._camera: Any = None
        self._gaps = FrameGaps(settings.frames_per_s)

    @property
    def name(self) -> str:
        """Name a person recognises."""
        return f"Raspberry Pi camera {self._settings.number}"

    def open(self) -> None:
        """Start the camera with fixed exposure, gain and focus.

        Raises:
            CameraMissingError: there is no camera, or no picamera2.
        """
        picamera2 = _library()
        if self._settings.number >= len(picamera2.Picamera2.global_camera_info()):
            raise CameraMissingError(
                f"{self.name} is not connected: check its ribbon cable, and what "
                "`rpicam-hello --list-cameras` says."
            )
        self._gaps.restart()
        try:
            camera = picamera2.Picamera2(self._settings.number)
            self._camera = camera
            camera.configure(
                camera.create_video_configuration(
                    # the first plane of YUV 420 is the grey picture
                    main={"size": (self._optics.width, self._optics.height), "format": "YUV420"},
                    controls=self._controls(),
                    buffer_count=3,
                )
            )
            camera.start()
        except (RuntimeError, IndexError) as error:
            raise CameraMissingError(
                f"{self.name} cannot be started: {error}. Does another program use it?"
            ) from error

    def read(self) -> RawFrame:
        """Wait for the next picture.

        Raises:
            CameraError: it is of another size than asked for.
        """
        request = self._camera.capture_request()
        try:
            planes = request.make_array("main")
            metadata = request.get_metadata()
        finally:
            request.release()
        height, width = self._optics.height, self._optics.width
        if planes.shape[0] < height or planes.shape[1] < width:
            raise CameraError(f"{self.name} delivers pictures of the shape {planes.shape}.")
        image = np.ascontiguousarray(planes[:height, :width], dtype=np.uint8)
        exposure_s = float(metadata.get("ExposureTime", 0.0)) * US
        captured_s = _captured_s(metadata.get("SensorTimestamp"), exposure_s)
        return RawFrame(image, captured_s, exposure_s, self._gaps.frames_since_last(captured_s))

    def skip(self) -> int:
        """Wait for the next picture without copying it."""
        request = self._camera.capture_request()
        try:
            metadata = request.get_metadata()
        finally:
            request.release()
        exposure_s = float(metadata.get("ExposureTime", 0.0)) * US
        captured_s = _captured_s(metadata.get("SensorTimestamp"), exposure_s)
        return self._gaps.frames_since_last(captured_s)

    def close(self) -> None:
        """Give the camera free."""
        camera, self._camera = self._camera, None
        if camera is not None:
            with contextlib.suppress(RuntimeError):  # it was never started
                camera.stop()
            camera.close()

    def _controls(self) -> dict[str, object]:
        settings = self._settings
        period_us = round(1.0 / settings.frames_per_s / US)
        controls: dict[str, object] = {"FrameDurationLimits": (period_us, period_us)}
        if settings.exposure_s is not None:
            controls |= {"AeEnable": False, "ExposureTime": round(settings.exposure_s / US)}
            if settings.gain is not None:
                controls["AnalogueGain"] = settings.gain
        if settings.focus_m is not None:
            # libcamera counts in dioptres
            controls |= {"AfMode": MANUAL_FOCUS, "LensPosition": 1.0 / settings.focus_m}
        return controls


def _library() -> Any:  # noqa: ANN401 - picamera2 has no types, and is not on every machine
    try:
        return importlib.import_module("picamera2")
    except ImportError as error:
        raise CameraMissingError(
            "The Raspberry Pi camera needs picamera2: `sudo apt install python3-picamera2`, and a "
            "virtual environment made with --system-site-packages."
        ) from error


def _captured_s(stamp_ns: int | None, exposure_s: float) -> float:
    """Middle of the exposure on the monotonic clock.

    libcamera stamps the start of the read-out, on the clock that also counts while the machine is
    suspended.
    """
    now_s = time.monotonic()
    if stamp_ns is None:
        return now_s - 0.5 * exposure_s
    age_s = time.clock_gettime(time.CLOCK_BOOTTIME) - stamp_ns * NS
    return now_s - age_s - 0.5 * exposure_s
