"""Projection, its derivatives, and its inverse."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.camera import CameraModel
from server.vision.projection import (
    perturbed,
    project,
    rotation_matrix,
    rotation_vector,
    undistort,
)
from tests.server.vision.pictures import pose

CAMERA = CameraModel(
    width=1640, height=1232, fx=1359.0, fy=1351.0, cx=822.0, cy=613.0,
    k1=-0.21, k2=0.11, p1=8e-4, p2=-5e-4, k3=-0.03,
)  # fmt: skip
POINTS = np.array([(-30.0, -30.0), (30.0, -30.0), (30.0, 30.0), (-30.0, 30.0), (3.0, 11.0)])

angles = st.floats(-40, 40)
places = st.floats(-60, 60)


def test_projection_is_that_of_opencv() -> None:
    T_camera_label = pose((25.0, -31.0, 240.0), (12.0, -23.0, 100.0))
    expected, _ = cv2.projectPoints(
        np.column_stack((POINTS, np.zeros(len(POINTS)))),
        rotation_vector(T_camera_label[:3, :3]),
        T_camera_label[:3, 3],
        CAMERA.matrix,
        CAMERA.distortion,
    )
    found = project(CAMERA, T_camera_label, POINTS).pixels
    np.testing.assert_allclose(found, np.asarray(expected).reshape(-1, 2), atol=1e-9)


@given(
    place=st.tuples(places, places, st.floats(150, 600)),
    tilt=st.tuples(angles, angles, st.floats(-170, 170)),
)
def test_derivative_by_the_pose_is_the_slope_of_the_projection(
    place: tuple[float, float, float], tilt: tuple[float, float, float]
) -> None:
    T_camera_label = pose(place, tilt)
    by_pose = project(CAMERA, T_camera_label, POINTS).by_pose
    for axis in range(6):
        step = np.zeros(6)
        step[axis] = 1e-5
        ahead = project(CAMERA, perturbed(T_camera_label, step), POINTS).pixels
        behind = project(CAMERA, perturbed(T_camera_label, -step), POINTS).pixels
        np.testing.assert_allclose(by_pose[:, :, axis], (ahead - behind) / 2e-5, atol=2e-5)


def test_derivative_by_the_point_is_the_slope_of_the_projection() -> None:
    T_camera_label = pose((25.0, -31.0, 240.0), (12.0, -23.0, 100.0))
    by_place = project(CAMERA, T_camera_label, POINTS).by_place
    for axis in range(3):
        ahead, behind = T_camera_label.copy(), T_camera_label.copy()
        ahead[axis, 3] += 1e-5
        behind[axis, 3] -= 1e-5
        slope = project(CAMERA, ahead, POINTS).pixels - project(CAMERA, behind, POINTS).pixels
        np.testing.assert_allclose(by_place[:, axis].T, slope / 2e-5, atol=1e-6)


@given(u=st.floats(0, 1639), v=st.floats(0, 1231))
def test_undistortion_undoes_the_projection(u: float, v: float) -> None:
    camera = CAMERA.model_copy(update={"k1": -0.05, "k2": 0.02, "k3": 0.0})
    ray = undistort(camera, np.array([[u, v]]))
    point = np.array([[*ray[0], 1.0]]) * 300.0
    assert project(camera, np.eye(4), point).pixels[0] == pytest.approx((u, v), abs=1e-4)


def test_a_perturbation_turns_the_label_about_its_own_centre_in_camera_axes() -> None:
    T_camera_label = pose((25.0, -31.0, 240.0), (12.0, -23.0, 100.0))
    moved = perturbed(T_camera_label, np.array([0.0, 0.0, 0.1, 1.0, 2.0, 3.0]))
    np.testing.assert_allclose(moved[:3, 3], (26.0, -29.0, 243.0))
    expected = rotation_matrix(np.array([0.0, 0.0, 0.1])) @ T_camera_label[:3, :3]
    np.testing.assert_allclose(moved[:3, :3], expected)
