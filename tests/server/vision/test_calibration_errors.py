"""What a wrong calibration does to a pose."""

from __future__ import annotations

import numpy as np
import pytest

from drivers.camera import CameraModel
from server.vision.average import combine
from server.vision.calibration_errors import CalibrationErrors
from server.vision.label_pose import LabelPose
from server.vision.projection import Array, perturbed, project
from tests.server.vision.pictures import pose, pose_error

CAMERA = CameraModel(width=1280, height=720, fx=1060.0, fy=1060.0, cx=640.0, cy=360.0)
SIZE_MM = 60.0
TRUE = pose((25.0, -14.0, 280.0), (2.0, 3.0, 20.0))


def solved(camera: CameraModel, pixels: Array, points_mm: Array) -> Array:
    """The pose that a camera model makes of pixels, by plain least squares."""
    found = TRUE
    for _ in range(30):
        seen = project(camera, found, points_mm)
        step = np.linalg.lstsq(seen.by_pose.reshape(-1, 6), (pixels - seen.pixels).ravel())[0]
        found = perturbed(found, step.astype(np.float64))
    return found


@pytest.mark.parametrize(
    ("wrong", "size_mm", "errors"),
    [
        ({"fx": 1060.0 * 1.003, "fy": 1060.0 * 1.003}, 60.0, CalibrationErrors(3e-3, 0.0, 0.0)),
        ({}, 60.2, CalibrationErrors(0.0, 0.0, 0.2)),
        ({"cx": 642.0, "cy": 358.0}, 60.0, CalibrationErrors(0.0, 2.0, 0.0)),
    ],
    ids=["focal length", "size", "principal point"],
)
def test_each_error_moves_the_pose_as_stated(
    wrong: dict[str, float], size_mm: float, errors: CalibrationErrors
) -> None:
    steps = np.linspace(-0.5, 0.5, 9)
    places = np.array([(x, y) for x in steps for y in steps])
    pixels = project(CAMERA, TRUE, places * SIZE_MM).pixels
    found = solved(CAMERA.model_copy(update=wrong), pixels, places * size_mm)
    moved = pose_error(found, TRUE)
    stated = np.sqrt(np.diag(errors.covariance(TRUE, CAMERA, SIZE_MM)))
    np.testing.assert_allclose(np.abs(moved[3:]), stated[3:], rtol=0.25, atol=0.02)
    np.testing.assert_allclose(moved[:3], 0.0, atol=4e-4)  # so it states no turn
    np.testing.assert_array_equal(stated[:3], 0.0)


def test_no_average_removes_it() -> None:
    covariance = np.diag([1e-8] * 3 + [1e-6] * 3)
    seen = LabelPose("label", TRUE, covariance, 0.03, 1.0, 600, 0.1)
    stated = CalibrationErrors().covariance(TRUE, CAMERA, SIZE_MM)
    mean = combine([seen] * 50, calibration=stated)
    assert np.all(np.diag(mean.covariance) >= np.diag(stated))
    assert mean.translation_sigma_mm[2] == pytest.approx(0.27, abs=0.05)
    np.linalg.cholesky(mean.covariance)  # positive definite, or it raises
