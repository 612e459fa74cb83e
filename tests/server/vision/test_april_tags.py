"""AprilTags behind the same interface as QR codes."""

from __future__ import annotations

import numpy as np
import pytest

from server.vision import Locator, PoseSource
from server.vision.errors import NoCodeError, WrongPayloadError
from server.vision.fitting.start_pose import corners_mm
from server.vision.markers.april_tags import AprilTags, tag_modules
from server.vision.projection import perturbed, project
from tests.server.vision.label_shots import CAMERA, PLACE, SIZE_MM, shot_of
from tests.server.vision.pictures import pose, pose_error
from tests.support.label_prints import mirrored, printed
from tests.support.picture_taking import Shot

TAG = "tag36h11:17"
LABEL = printed(tag_modules(TAG), SIZE_MM, ink_modules=0.02)


def test_a_tag_has_a_black_frame_and_an_inside_of_its_own() -> None:
    modules = tag_modules(TAG)
    assert modules.shape == (8, 8)
    frame = modules.copy()
    frame[1:-1, 1:-1] = True
    assert frame.all()
    assert not np.array_equal(modules, tag_modules("tag36h11:18"))


@pytest.mark.parametrize("name", ["tag36h11:587", "tag36h11:-1", "tag25h9:3", "17", "tag36h11:017"])
def test_there_are_no_other_tags(name: str) -> None:
    with pytest.raises(ValueError, match="is no tag"):
        tag_modules(name)


@pytest.mark.parametrize("distance_mm", [135.0, 230.0, 450.0])
@pytest.mark.parametrize("turn_deg", [3.0, 100.0, 190.0])
def test_a_tag_is_located_like_a_code(distance_mm: float, turn_deg: float) -> None:
    true = pose((0.01 * distance_mm, -4.0, distance_mm), (6.0, -5.0, turn_deg))
    locator = Locator(CAMERA, marker=AprilTags())
    found = locator.locate(
        shot_of(LABEL, true, shot=Shot(blur_px=1.0)), label_size_mm=SIZE_MM, expected_payload=TAG
    )
    assert found.payload == TAG
    assert found.source is PoseSource.EDGES
    error = pose_error(found.T_camera_label, true)
    assert np.abs(error[3:5]).max() < 0.03
    assert abs(error[5]) < 0.0005 * distance_mm
    assert np.degrees(np.abs(error[:3]).max()) < 0.25


def test_a_tag_is_followed_and_found_near_its_place() -> None:
    marker = AprilTags()
    locator = Locator(CAMERA, marker=marker)
    image = shot_of(LABEL)
    predicted = perturbed(PLACE, np.array([0.01, -0.01, 0.0, 0.4, -0.4, 1.0]))
    for _ in range(13):
        found = locator.locate(image, label_size_mm=SIZE_MM, predicted=predicted)
        assert np.abs(pose_error(found.T_camera_label, PLACE)[3:5]).max() < 0.02
    corners = project(CAMERA, PLACE, corners_mm(SIZE_MM)).pixels
    near = marker.find_near(image, corners, TAG)
    assert near is not None
    assert np.abs(near.corners_px - corners).max() < 9.0  # the fit does the rest
    assert marker.find_near(image, corners, "tag36h11:18") is None
    assert marker.find_near(image, corners + 5000.0, TAG) is None


def test_another_tag_and_none_are_told_apart() -> None:
    locator = Locator(CAMERA, marker=AprilTags())
    with pytest.raises(WrongPayloadError):
        locator.locate(shot_of(LABEL), label_size_mm=SIZE_MM, expected_payload="tag36h11:3")
    with pytest.raises(NoCodeError):
        locator.locate(shot_of(mirrored(LABEL)), label_size_mm=SIZE_MM)
