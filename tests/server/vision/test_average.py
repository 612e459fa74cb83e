"""Averaging poses at standstill."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from server.vision.average import CommonErrors, combine
from server.vision.label_pose import LabelPose, PoseSource
from server.vision.projection import Array, perturbed
from tests.server.vision.pictures import PAYLOAD, pose, pose_error

TRUE = pose((10.0, -5.0, 290.0), (2.0, -3.0, 180.0))
NOTHING = CommonErrors(rotation_rad=0.0, lateral_mm=0.0, depth_mm=0.0)
SIGMA = np.array([3e-4, 3e-4, 2e-5, 5e-4, 5e-4, 6e-3])


def label_pose(T_camera_label: Array, sigma: Array = SIGMA) -> LabelPose:
    return LabelPose(
        payload=PAYLOAD,
        T_camera_label=T_camera_label,
        covariance=np.diag(sigma**2),
        rms_px=0.03,
        inlier_share=0.99,
        edge_count=800,
        spread_px=-0.2,
    )


def test_one_pose_stays_itself_but_for_the_common_errors() -> None:
    common = CommonErrors(rotation_rad=1e-3, lateral_mm=0.1, depth_mm=0.2)
    mean = combine([label_pose(TRUE)], common)
    np.testing.assert_allclose(mean.T_camera_label, TRUE, atol=1e-12)
    np.testing.assert_allclose(np.diag(mean.covariance)[3:5], SIGMA[3:5] ** 2 + 0.01)
    assert mean.covariance[5, 5] == pytest.approx(SIGMA[5] ** 2 + 0.04)


def test_the_mean_of_many_is_as_good_as_it_says() -> None:
    rng = np.random.default_rng(11)
    chi2 = []
    for _ in range(80):
        poses = [label_pose(perturbed(TRUE, rng.normal(0, SIGMA))) for _ in range(9)]
        mean = combine(poses, NOTHING)
        error = pose_error(mean.T_camera_label, TRUE)
        chi2.append(error @ np.linalg.solve(mean.covariance, error))
        assert mean.covariance[5, 5] < 2.5 * SIGMA[5] ** 2 / 9
    assert 4.5 < float(np.mean(chi2)) < 7.2


def test_a_certain_pose_weighs_more_than_an_uncertain_one() -> None:
    off = perturbed(TRUE, np.array([0, 0, 0, 0.5, 0, 0]))
    mean = combine([label_pose(TRUE), label_pose(off, 10 * SIGMA)], NOTHING)
    assert mean.T_camera_label[0, 3] - TRUE[0, 3] == pytest.approx(0.5 / 101)


def test_poses_that_disagree_more_than_they_promise_widen_the_covariance() -> None:
    off = perturbed(TRUE, np.array([0, 0, 0, 20 * SIGMA[3], 0, 0]))
    calm = combine([label_pose(TRUE), label_pose(TRUE)], NOTHING)
    torn = combine([label_pose(TRUE), label_pose(off)], NOTHING)
    assert torn.covariance[3, 3] > 20 * calm.covariance[3, 3]


def test_a_coarse_pose_among_them_shows_in_the_source() -> None:
    coarse = replace(label_pose(TRUE), source=PoseSource.CORNERS)
    assert combine([label_pose(TRUE), label_pose(TRUE)]).source is PoseSource.EDGES
    assert combine([label_pose(TRUE), coarse]).source is PoseSource.CORNERS


def test_nothing_and_different_labels_cannot_be_combined() -> None:
    with pytest.raises(ValueError, match="no pose"):
        combine([])
    with pytest.raises(ValueError, match="different labels"):
        combine([label_pose(TRUE), replace(label_pose(TRUE), payload="other")])
