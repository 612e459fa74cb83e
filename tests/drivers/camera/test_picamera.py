"""How the Raspberry Pi camera is set up and read, against a stand-in for picamera2."""

from __future__ import annotations

import sys
import time
from types import SimpleNamespace
from typing import Any, ClassVar

import numpy as np
import pytest

from drivers.camera import CameraModel
from drivers.camera.errors import CameraMissingError
from drivers.camera.picamera import PiCameraSource
from drivers.camera.settings import PiCameraSettings

OPTICS = CameraModel(width=64, height=48, fx=50, fy=50, cx=32, cy=24)
PADDED_WIDTH = 128  # picamera2 pads lines


class Picamera2:
    connected: ClassVar[int] = 1
    busy: ClassVar[bool] = False
    newest: ClassVar[Any] = None

    def __init__(self, number: int) -> None:
        self.number = number
        self.running = False
        self.released = 0
        self.age_s = 0.0
        self.configuration: dict[str, Any] = {}
        if Picamera2.busy:
            raise RuntimeError("Failed to acquire camera: Device or resource busy")
        Picamera2.newest = self

    @staticmethod
    def global_camera_info() -> list[dict[str, object]]:
        return [{"Num": number} for number in range(Picamera2.connected)]

    def create_video_configuration(self, **configuration: Any) -> dict[str, Any]:  # noqa: ANN401
        return configuration

    def configure(self, configuration: dict[str, Any]) -> None:
        self.configuration = configuration

    def start(self) -> None:
        self.running = True

    def stop(self) -> None:
        self.running = False

    def close(self) -> None: ...

    def capture_request(self) -> Any:  # noqa: ANN401 - a stand-in, too
        planes = np.zeros((48 * 3 // 2, PADDED_WIDTH), dtype=np.uint8)
        planes[:48, :64] = 77
        stamp_ns = round((time.clock_gettime(time.CLOCK_BOOTTIME) - self.age_s) * 1e9)
        return SimpleNamespace(
            make_array=lambda _: planes,
            get_metadata=lambda: {"SensorTimestamp": stamp_ns, "ExposureTime": 8000},
            release=self._release,
        )

    def _release(self) -> None:
        self.released += 1


@pytest.fixture
def library(monkeypatch: pytest.MonkeyPatch) -> type[Picamera2]:
    monkeypatch.setitem(sys.modules, "picamera2", SimpleNamespace(Picamera2=Picamera2))
    monkeypatch.setattr(Picamera2, "connected", 1)
    monkeypatch.setattr(Picamera2, "busy", False)
    return Picamera2


def test_everything_is_fixed_when_it_starts(library: type[Picamera2]) -> None:
    PiCameraSource(
        PiCameraSettings(frames_per_s=25, exposure_s=0.004, gain=3.0, focus_m=0.4), OPTICS
    ).open()
    camera = library.newest
    assert camera.running
    assert camera.configuration["main"] == {"size": (64, 48), "format": "YUV420"}
    assert camera.configuration["controls"] == {
        "FrameDurationLimits": (40000, 40000),
        "AeEnable": False,
        "ExposureTime": 4000,
        "AnalogueGain": 3.0,
        "AfMode": 0,
        "LensPosition": 2.5,
    }


def test_exposure_is_left_to_the_camera_when_wanted(library: type[Picamera2]) -> None:
    PiCameraSource(PiCameraSettings(exposure_s=None), OPTICS).open()
    assert set(library.newest.configuration["controls"]) == {"FrameDurationLimits"}


def test_a_picture_is_the_grey_plane_at_the_middle_of_its_exposure(
    library: type[Picamera2],
) -> None:
    source = PiCameraSource(PiCameraSettings(), OPTICS)
    source.open()
    library.newest.age_s = 0.3
    frame = source.read()
    assert frame.image.shape == (48, 64)
    assert np.all(frame.image == 77)
    assert frame.exposure_s == pytest.approx(0.008)
    assert time.monotonic() - frame.captured_s == pytest.approx(0.304, abs=0.1)
    assert source.skip() >= 1
    assert library.newest.released == 2
    source.close()
    assert not library.newest.running


def test_a_camera_that_is_not_connected(library: type[Picamera2]) -> None:
    library.connected = 0
    with pytest.raises(CameraMissingError, match="ribbon cable"):
        PiCameraSource(PiCameraSettings(), OPTICS).open()


def test_a_camera_that_somebody_else_uses(library: type[Picamera2]) -> None:
    library.busy = True
    source = PiCameraSource(PiCameraSettings(), OPTICS)
    with pytest.raises(CameraMissingError, match="Does another program use it"):
        source.open()
    source.close()


def test_a_machine_without_picamera2(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "picamera2", None)
    with pytest.raises(CameraMissingError, match="apt install python3-picamera2"):
        PiCameraSource(PiCameraSettings(), OPTICS).open()
