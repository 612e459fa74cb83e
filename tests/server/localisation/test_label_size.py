"""The label's true size from looks at it from different places."""

from __future__ import annotations

import math

import numpy as np
import pytest

from server.localisation.errors import LabelSizeWrongError
from server.localisation.frames import base_from_camera
from server.localisation.label_size import LabelSizeCheck
from server.vision import LabelPose
from tests.support.robot_cell import GEOMETRY, HOME
from twin.camera_mount import CameraMount
from twin.joints import JointPosition

MOUNT = CameraMount(rotation_x_rad=0.1, rotation_y_rad=-0.05)
LABEL_MM = np.array([640.0, 300.0, 420.0])
THERE = JointPosition(HOME.rho1_mm + 60.0, HOME.rho2_mm - 40.0, HOME.rho3_mm)
NEAR_HERE = JointPosition(HOME.rho1_mm + 1.0, HOME.rho2_mm - 1.0, HOME.rho3_mm)


def sighting(T_base_camera: np.ndarray, ratio: float, noise_mm: float = 0.0) -> LabelPose:
    """What a locator that was told a wrong size sees: everything farther away by the ratio."""
    true = np.linalg.inv(T_base_camera) @ np.array([*LABEL_MM, 1.0])
    pose = np.eye(4)
    pose[:3, 3] = true[:3] / ratio + noise_mm
    covariance = np.diag([1e-6, 1e-6, 1e-6, 1e-4, 1e-4, 1e-2])
    return LabelPose("label", pose, covariance, 0.03, 1.0, 600, 0.1)


def looked(ratio: float, *places: JointPosition) -> LabelSizeCheck:
    check = LabelSizeCheck()
    for joints in places:
        T_base_camera = base_from_camera(GEOMETRY, MOUNT, joints)
        check.add(sighting(T_base_camera, ratio), T_base_camera)
    return check


@pytest.mark.parametrize("ratio", [0.8, 0.97, 1.0, 1.05, 2.0])
def test_the_ratio_is_found_from_two_places(ratio: float) -> None:
    estimate = looked(ratio, HOME, THERE).estimate
    assert estimate.ratio == pytest.approx(ratio, rel=1e-9)
    assert 0.002 < estimate.sigma < 0.03


@pytest.mark.parametrize("ratio", [0.9, 1.08])
def test_a_wrong_size_is_told_with_the_measured_one(ratio: float) -> None:
    with pytest.raises(LabelSizeWrongError) as caught:
        looked(ratio, HOME, THERE).require_right_size(60.0)
    assert caught.value.code == "label_size_wrong"
    assert caught.value.context["measured_mm"] == pytest.approx(60.0 * ratio, abs=0.01)
    assert f"{60.0 * ratio:.1f} mm" in caught.value.detail


def test_the_right_size_passes() -> None:
    looked(1.0, HOME, THERE).require_right_size(60.0)
    looked(1.01, HOME, THERE).require_right_size(60.0)


@pytest.mark.parametrize("places", [(), (HOME,), (HOME, HOME), (HOME, NEAR_HERE)])
def test_without_a_way_between_the_looks_nothing_is_claimed(
    places: tuple[JointPosition, ...],
) -> None:
    check = looked(1.2, *places)
    check.require_right_size(60.0)
    assert check.estimate.sigma > 0.1


def test_the_first_look_is_kept_when_many_follow() -> None:
    check = looked(0.9, HOME, *([THERE] * 30))
    assert check.estimate.ratio == pytest.approx(0.9, rel=1e-6)


def test_the_stated_sigma_is_what_play_of_the_robot_does() -> None:
    rng = np.random.default_rng(4)
    ratios, sigma = [], math.nan
    for _ in range(400):
        check = LabelSizeCheck()
        for joints in (HOME, THERE):
            T_base_camera = base_from_camera(GEOMETRY, MOUNT, joints)
            seen = sighting(T_base_camera, 1.0)
            believed = T_base_camera.copy()
            believed[:3, 3] += rng.normal(0, 0.5, 3)
            check.add(seen, believed)
        ratios.append(check.estimate.ratio)
        sigma = check.estimate.sigma
    assert np.std(ratios) == pytest.approx(sigma, rel=0.15)
