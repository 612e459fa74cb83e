"""What spoils pictures: accuracy suffers, honesty does not. The large run is tests.bench.vision."""

from __future__ import annotations

import numpy as np
import pytest

from server.vision import Locator
from server.vision.projection import Array
from tests.server.vision.label_shots import CAMERA, LABEL, PLACE, SIZE_MM, shot_of
from tests.server.vision.pictures import pose, pose_error
from tests.support.picture_taking import Shot

CHI2_9999_OF_SIX = 27.86


def errors(shots: list[Shot], T_camera_label: Array = PLACE) -> tuple[Array, Array]:
    """Pose errors, shape (n, 6), and normalised squared errors, shape (n,)."""
    locator = Locator(CAMERA)
    found, distances = [], []
    for seed, shot in enumerate(shots):
        image = shot_of(LABEL, T_camera_label, shot=shot, seed=seed)
        pose_found = locator.locate(image, label_size_mm=SIZE_MM)
        error = pose_error(pose_found.T_camera_label, T_camera_label)
        found.append(error)
        distances.append(error @ np.linalg.solve(pose_found.covariance, error))
    return np.array(found), np.array(distances)


@pytest.mark.parametrize(
    ("shots", "lateral_mm", "depth_mm", "tilt_deg"),
    [
        ([Shot()] * 6, 0.004, 0.02, 0.03),
        ([Shot(motion_px=way) for way in ((4, 0), (0, 4), (3, 3), (-2, 3))], 0.03, 0.15, 0.15),
        ([Shot(glare=((u, 0.45, 0.15, 0.5),)) for u in (0.3, 0.4, 0.5, 0.6)], 0.02, 0.08, 0.20),
        ([Shot(jpeg=70)] * 6, 0.012, 0.06, 0.10),
        ([Shot(gradient=(0.9, -0.6)), Shot(gradient=(-0.9, 0.8))], 0.004, 0.02, 0.03),
        ([Shot(full_well=200.0, read_noise=0.03)] * 6, 0.04, 0.2, 0.3),
        ([Shot(blur_px=2.2), Shot(blur_px=0.45), Shot(sharpening=0.8)], 0.02, 0.08, 0.15),
    ],
    ids=["plain", "motion", "glare", "jpeg", "slope of the light", "noise", "focus"],
)
def test_errors_stay_small_and_promised(
    shots: list[Shot], lateral_mm: float, depth_mm: float, tilt_deg: float
) -> None:
    found, distances = errors(shots)
    assert np.hypot(found[:, 3], found[:, 4]).max() < lateral_mm
    assert np.abs(found[:, 5]).max() < depth_mm
    assert np.degrees(np.hypot(found[:, 0], found[:, 1])).max() < tilt_deg
    # A reflection that clips half of the label is the worst of them: twice what is promised.
    assert np.median(distances) < 12.0
    assert distances.max() < CHI2_9999_OF_SIX


def test_motion_longer_than_a_module_makes_the_pose_uncertain_not_wrong() -> None:
    """Blurred beyond the profiles' ends, edges move less than the label: the gain knows."""
    far = pose((10.0, -20.0, 450.0), (4.0, -5.0, 8.0))  # modules of 3.7 px
    sharp, _ = errors([Shot()] * 3, far)
    found, distances = errors([Shot(motion_px=(4.5, 0.0))] * 6, far)
    assert distances.max() < CHI2_9999_OF_SIX
    assert np.abs(found[:, 3]).max() < 0.4
    assert np.abs(sharp[:, 3]).max() < 0.03


def test_blur_does_not_move_the_depth() -> None:
    """Lone modules get neither black nor white in it, the code's border does: no light grows."""
    found, _ = errors([Shot(blur_px=2.2)] * 6, pose((6.0, -4.0, 300.0), (4.0, -5.0, 8.0)))
    assert abs(float(found[:, 5].mean())) < 0.025
