"""Blur against the equation of the thin lens."""

from __future__ import annotations

import numpy as np
import pytest

from drivers.camera import CameraModel, pi_camera_v2
from drivers.simulator.camera.blur_kernels import disc_kernel, line_kernel
from drivers.simulator.camera.imaging import ImagingParameters
from drivers.simulator.camera.scene import SceneRenderer
from tests.drivers.simulator.camera.scenes import SIZE_MM, pose, view

OPTICS = CameraModel(width=640, height=480, fx=1359.0, fy=1359.0, cx=319.5, cy=239.5)
IMAGING = ImagingParameters(readout_s=0.0)


def test_the_circle_of_confusion_is_that_of_a_thin_lens() -> None:
    """By hand: images of a point form at f d / (d - f); similar triangles give the disc."""
    optics, f_mm = pi_camera_v2(), 3.04
    sensor_mm = f_mm * 360.0 / (360.0 - f_mm)
    for distance_mm in (110.0, 200.0, 360.0, 600.0):
        image_mm = f_mm * distance_mm / (distance_mm - f_mm)
        disc_mm = (f_mm / 2.0) * abs(sensor_mm - image_mm) / image_mm
        expected_px = disc_mm * optics.fx / f_mm
        assert ImagingParameters().disc_px(distance_mm, optics) == pytest.approx(expected_px)
    assert ImagingParameters().blur_px(360.0, optics) == pytest.approx(0.55)


@pytest.mark.parametrize("distance_mm", [90.0, 130.0, 200.0, 360.0, 500.0])
def test_edges_in_the_picture_are_as_soft_as_the_equation_says(distance_mm: float) -> None:
    """The left edge of the label lies in the middle of the picture; its slope is the blur."""
    label = pose(SIZE_MM * 33 / 25 / 2, 0.0, distance_mm)
    far = view(label, socket_mm=(5000.0, 0.0, 0.0))
    canvas = SceneRenderer(OPTICS, IMAGING).render(far).canvas
    half = int(4 * IMAGING.blur_px(distance_mm, OPTICS)) + 3
    slope = np.diff(canvas[235:245].mean(axis=0)[320 - half : 320 + half])
    slope -= slope[[0, -1]].mean()  # the paint has slopes of its own
    places = np.arange(len(slope))
    middle = (places * slope).sum() / slope.sum()
    variance = ((places - middle) ** 2 * slope).sum() / slope.sum()
    spread = np.sqrt(variance - 1 / 12)  # of the differences themselves
    assert spread == pytest.approx(IMAGING.blur_px(distance_mm, OPTICS), rel=0.05)


@pytest.mark.parametrize("diameter", [6.0, 9.4, 24.0])
def test_a_disc_has_a_sixteenth_of_its_squared_diameter_as_variance(diameter: float) -> None:
    kernel = disc_kernel(diameter)
    places = np.arange(len(kernel)) - len(kernel) // 2
    assert kernel.sum() == pytest.approx(1.0, abs=1e-5)
    variance = (kernel.sum(axis=0) * places**2).sum() - 1 / 12  # of the texels themselves
    assert variance == pytest.approx(diameter**2 / 16, rel=0.03)


def test_a_line_is_as_long_as_the_way() -> None:
    kernel = line_kernel(np.array([8.0, 0.0]))
    assert kernel is not None
    places = np.arange(len(kernel)) - len(kernel) // 2
    assert (kernel.sum(axis=0) * places**2).sum() == pytest.approx(8.0**2 / 12, rel=0.05)
    assert line_kernel(np.array([0.0, 0.01])) is None
