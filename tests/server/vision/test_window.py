"""The part of a picture around an expected code."""

from __future__ import annotations

import numpy as np
import pytest

from server.vision.fitting.start_pose import corners_mm
from server.vision.markers.qr_codes import QrCodes
from server.vision.markers.window import window_around
from server.vision.projection import Array, project
from tests.server.vision.label_shots import CAMERA, LABEL, MODULES, SIZE_MM, shot_of
from tests.server.vision.pictures import PAYLOAD, pose


def corners_of(T_camera_label: Array) -> Array:
    return project(CAMERA, T_camera_label, corners_mm(SIZE_MM)).pixels


@pytest.mark.parametrize("distance_mm", [105.0, 230.0, 800.0])
def test_the_code_is_read_in_its_window_with_corners_of_the_whole(distance_mm: float) -> None:
    true = pose((0.05 * distance_mm, 2.0, distance_mm), (3.0, 4.0, 10.0))
    corners = corners_of(true)
    code = QrCodes().find_near(shot_of(LABEL, true), corners + 3.0, PAYLOAD)
    assert code is not None
    assert np.abs(code.corners_px - corners).max() < 4.0
    np.testing.assert_array_equal(code.modules, MODULES)


def test_the_window_stays_inside_the_picture() -> None:
    image = shot_of()
    corners = np.array([(-40.0, -40.0), (60.0, -40.0), (60.0, 60.0), (-40.0, 60.0)])
    window = window_around(image, corners)
    assert window is not None
    assert window.left_top_px == (0.0, 0.0)
    assert window_around(image, corners - 500.0) is None
    assert window_around(image, corners + 1e6) is None


def test_another_text_is_not_found() -> None:
    true = pose((0.0, 2.0, 230.0))
    assert QrCodes().find_near(shot_of(LABEL, true), corners_of(true), "other") is None
