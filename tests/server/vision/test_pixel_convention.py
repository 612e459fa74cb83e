"""Pixel centres are at integers: checked against brute-force pictures without the renderer."""

from __future__ import annotations

import numpy as np
import pytest

from drivers.camera import CameraModel
from server.vision.fitting.start_pose import corners_mm
from server.vision.locator import Locator
from server.vision.projection import Array, project
from tests.server.vision.pictures import PAYLOAD, SIZE_MM, ideal_picture, pose, pose_error
from twin.qr_label import label_modules

CAMERA = CameraModel(width=260, height=240, fx=480.0, fy=480.0, cx=132.3, cy=118.9)


@pytest.mark.parametrize(
    "T_camera_label",
    [
        pose((0.0, 0.0, 200.0)),
        pose((1.37, -2.11, 190.0), (0.0, 0.0, 90.0)),
        pose((-4.2, 3.3, 205.0), (9.0, -14.0, 23.0)),
    ],
    ids=["head-on", "quarter turn", "oblique"],
)
def test_an_ideal_picture_is_located_to_hundredths_of_a_pixel(T_camera_label: Array) -> None:
    image = ideal_picture(CAMERA, label_modules(PAYLOAD), T_camera_label, fineness=10)
    found = Locator(CAMERA).locate(image, label_size_mm=SIZE_MM)
    corners = corners_mm(SIZE_MM)
    there = project(CAMERA, found.T_camera_label, corners).pixels
    true = project(CAMERA, T_camera_label, corners).pixels
    np.testing.assert_allclose(there, true, atol=0.03)
    # A convention wrong by half a pixel would be 0.17 mm here.
    assert np.abs(pose_error(found.T_camera_label, T_camera_label)[3:5]).max() < 0.003
    # Both halves of a pixel on an edge are counted right: no spread without ink.
    assert abs(found.spread_px) < 0.03
