"""The fit to the module edges."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from drivers.camera import CameraModel
from server.vision.fitting.bit_agreement import bit_agreement
from server.vision.fitting.code_edges import code_edges
from server.vision.fitting.edge_fit import fit_edges
from server.vision.projection import Array, perturbed
from tests.server.vision.pictures import (
    OPTICS,
    PAYLOAD,
    SIZE_MM,
    ideal_picture,
    picture,
    pose,
    pose_error,
    view,
)
from twin.qr_label import label_modules

MODULES = label_modules(PAYLOAD)
EDGES = code_edges(MODULES, SIZE_MM)
TRUE = pose((3.0, -4.0, 290.0), (1.0, -1.5, 5.0))
MODULE_MM = SIZE_MM / len(MODULES)


@pytest.mark.parametrize(
    "start",
    [
        np.zeros(6),
        np.array([0.0, 0.0, 0.0, 0.35 * MODULE_MM, 0.35 * MODULE_MM, 0.0]),
        np.array([0.05, -0.05, 0.0, 0.0, 0.0, 0.0]),
        np.array([0.0, 0.0, 0.01, 0.2, -0.2, 2.9]),
    ],
    ids=["at the truth", "sideways", "tilted", "turned and too far"],
)
def test_the_fit_forgets_where_it_started(start: Array) -> None:
    fit = fit_edges(picture(view(TRUE)), OPTICS, EDGES, perturbed(TRUE, start))
    assert fit is not None
    error = pose_error(fit.T_camera_label, TRUE)
    assert np.abs(error[3:5]).max() < 0.005
    assert abs(error[5]) < 0.03
    assert fit.inlier_share > 0.95
    assert fit.rms_px < 0.05


def test_ink_spread_does_not_change_the_distance() -> None:
    """Black areas 0.2 px wider on all sides: the seventh unknown takes it, not the depth."""
    camera = CameraModel(width=260, height=240, fx=480.0, fy=480.0, cx=132.3, cy=118.9)
    true = pose((1.0, 2.0, 200.0), (4.0, 3.0, 0.0))
    ideal = ideal_picture(camera, MODULES, true, fineness=8)
    # A gamma curve after blur moves the edges as ink does.
    dark = (255 * (ideal / 255.0) ** 2.2).astype(np.uint8)
    fits = [fit_edges(image, camera, EDGES, true) for image in (ideal, dark)]
    assert fits[0] is not None
    assert fits[1] is not None
    assert fits[1].spread_px - fits[0].spread_px > 0.08
    assert abs(fits[1].T_camera_label[2, 3] - fits[0].T_camera_label[2, 3]) < 0.04


def test_a_covered_corner_of_the_label_does_not_pull_the_fit() -> None:
    image = picture(view(TRUE))
    image[680:760, 880:1000] = 90
    clean = fit_edges(picture(view(TRUE)), OPTICS, EDGES, TRUE)
    fit = fit_edges(image, OPTICS, EDGES, TRUE)
    assert fit is not None
    assert clean is not None
    assert fit.inlier_share < clean.inlier_share - 0.02
    assert np.abs(pose_error(fit.T_camera_label, TRUE)[3:5]).max() < 0.01


def test_a_noisier_picture_gives_a_larger_covariance() -> None:
    bright = fit_edges(picture(view(TRUE)), OPTICS, EDGES, TRUE)
    dim = fit_edges(picture(view(TRUE), ambient=0.05), OPTICS, EDGES, TRUE)
    assert bright is not None
    assert dim is not None
    assert dim.covariance[3, 3] > 4 * bright.covariance[3, 3]


def test_without_a_label_there_is_no_fit() -> None:
    grey = np.full((OPTICS.height, OPTICS.width), 100, dtype=np.uint8)
    assert fit_edges(grey, OPTICS, EDGES, TRUE) is None
    outside = pose((900.0, 0.0, 290.0))
    assert fit_edges(picture(view(TRUE)), OPTICS, EDGES, outside) is None


def test_bits_agree_at_the_true_pose_only() -> None:
    image = picture(view(TRUE))
    assert bit_agreement(image, OPTICS, MODULES, TRUE, SIZE_MM) > 0.99
    slipped = TRUE.copy()
    slipped[0, 3] += MODULE_MM
    assert bit_agreement(image, OPTICS, MODULES, slipped, SIZE_MM) < 0.75
    assert bit_agreement(255 - image, OPTICS, MODULES, TRUE, SIZE_MM) < 0.05


@pytest.mark.parametrize("seed", range(12))
def test_meaningless_pictures_give_no_fit_or_a_bad_one_but_no_surprise(seed: int) -> None:
    rng = np.random.default_rng(seed)
    noise = rng.integers(0, 256, (60, 80), dtype=np.uint8)
    size = (OPTICS.width, OPTICS.height)
    image = np.asarray(cv2.resize(noise, size, interpolation=cv2.INTER_CUBIC), dtype=np.uint8)
    start = pose(rng.uniform((-40, -40, 210), (40, 40, 290)), rng.uniform(-50, 50, 3))
    fit = fit_edges(image, OPTICS, EDGES, start)
    if fit is not None:
        agreement = bit_agreement(image, OPTICS, MODULES, fit.T_camera_label, SIZE_MM)
        assert agreement < 0.75
