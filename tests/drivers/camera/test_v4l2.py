"""How a USB camera is set up and read, against a stand-in for OpenCV's capture."""

from __future__ import annotations

import time
from typing import Any

import cv2
import numpy as np
import pytest

from drivers.camera import CameraModel
from drivers.camera.errors import CameraMissingError, WrongResolutionError
from drivers.camera.settings import V4l2Settings
from drivers.camera.v4l2 import V4l2Source

OPTICS = CameraModel(width=64, height=48, fx=50, fy=50, cx=32, cy=24)


class Device:
    """Behaves like cv2.VideoCapture on a camera with some of the controls."""

    def __init__(self, *, there: bool = True, size: tuple[int, int] | None = None) -> None:
        self.there = there
        self.size = size
        self.controls: dict[int, float] = {}
        self.stamp_s: float | None = None
        self.released = False
        self.plugged = True

    def isOpened(self) -> bool:  # noqa: N802 - OpenCV's name
        return self.there

    def set(self, control: int, value: float) -> bool:
        if control == cv2.CAP_PROP_FOCUS:
            return False  # a fixed lens
        self.controls[control] = value
        return True

    def get(self, control: int) -> float:
        if control == cv2.CAP_PROP_POS_MSEC:
            return 0.0 if self.stamp_s is None else 1000 * self.stamp_s
        if self.size is not None and control in (
            cv2.CAP_PROP_FRAME_WIDTH,
            cv2.CAP_PROP_FRAME_HEIGHT,
        ):
            return self.size[control == cv2.CAP_PROP_FRAME_HEIGHT]
        return self.controls.get(control, 0.0)

    def grab(self) -> bool:
        return self.plugged

    def read(self) -> tuple[bool, Any]:
        if not self.plugged:
            return False, None
        return True, np.full((48, 64, 3), (10, 20, 30), dtype=np.uint8)

    def release(self) -> None:
        self.released = True


def source(device: Device, **settings: Any) -> V4l2Source:  # noqa: ANN401 - of the model
    return V4l2Source(V4l2Settings(**settings), OPTICS, lambda _: device)


def test_exposure_and_focus_are_fixed_when_it_opens() -> None:
    device = Device()
    source(device, exposure_s=0.008, gain=4.0, focus=30).open()
    assert device.controls[cv2.CAP_PROP_AUTO_EXPOSURE] == 1
    assert device.controls[cv2.CAP_PROP_EXPOSURE] == 80  # in units of 100 us
    assert device.controls[cv2.CAP_PROP_GAIN] == 4.0
    assert device.controls[cv2.CAP_PROP_AUTOFOCUS] == 0
    assert device.controls[cv2.CAP_PROP_BUFFERSIZE] == 1
    assert device.controls[cv2.CAP_PROP_FOURCC] == cv2.VideoWriter.fourcc(*"MJPG")


def test_exposure_is_left_to_the_camera_when_wanted() -> None:
    device = Device()
    source(device, exposure_s=None).open()
    assert device.controls[cv2.CAP_PROP_AUTO_EXPOSURE] == 3
    assert cv2.CAP_PROP_EXPOSURE not in device.controls


def test_a_picture_is_grey_and_has_the_time_of_the_kernel() -> None:
    device = Device()
    camera = source(device, exposure_s=0.01)
    camera.open()
    device.stamp_s = time.monotonic() - 0.5
    frame = camera.read()
    assert frame.image.shape == (48, 64)
    assert frame.image.dtype == np.uint8
    assert frame.captured_s == pytest.approx(device.stamp_s - 0.005, abs=1e-6)


def test_a_stamp_of_another_clock_is_not_believed() -> None:
    device = Device()
    camera = source(device, exposure_s=0.01)
    camera.open()
    device.stamp_s = time.monotonic() + 1e6
    assert time.monotonic() - camera.read().captured_s == pytest.approx(0.005, abs=0.1)


def test_gaps_in_the_stamps_are_lost_pictures() -> None:
    device = Device()
    camera = source(device, frames_per_s=20.0)
    camera.open()
    began_s = time.monotonic() - 1.0
    counts = []
    for at_s in (0.0, 0.05, 0.2, 0.26):
        device.stamp_s = began_s + at_s
        counts.append(camera.read().frames_since_last)
    device.stamp_s = began_s + 0.36
    counts.append(camera.skip())
    assert counts == [1, 1, 3, 1, 2]


def test_a_camera_that_cannot_do_the_calibrated_size_is_refused() -> None:
    with pytest.raises(WrongResolutionError, match=r"32 x 24 pixels in place of .* 64 x 48"):
        source(Device(size=(32, 24))).open()


def test_a_missing_device_is_named_and_given_back() -> None:
    device = Device(there=False)
    with pytest.raises(CameraMissingError, match="Camera /dev/video0 cannot be opened"):
        source(device).open()
    assert device.released


def test_a_camera_that_is_pulled_out_is_missing() -> None:
    device = Device()
    camera = source(device)
    camera.open()
    device.plugged = False
    with pytest.raises(CameraMissingError, match="check its cable"):
        camera.read()
    with pytest.raises(CameraMissingError, match="check its cable"):
        camera.skip()
    camera.close()
    assert device.released


def test_opencv_says_the_same_of_a_device_that_does_not_exist() -> None:
    camera = V4l2Source(V4l2Settings(device="/dev/video-that-is-not-there"), OPTICS)
    with pytest.raises(CameraMissingError):
        camera.open()
