"""Whether true errors are as large as the covariance says, no larger and no smaller.

The sum of n normalised squared errors of six numbers is chi^2 of 6 n, so its mean per number is 1
with a standard deviation of sqrt(2 / 6 n): 0.07 for seventy pictures. A covariance that is off by
a factor of 1.5 fails in at least one direction. The large run is ``tests.bench.vision``.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

from server.vision.fitting.code_edges import code_edges
from server.vision.fitting.edge_fit import fit_edges
from server.vision.projection import Array, perturbed
from tests.server.vision.label_shots import CAMERA, LABEL, MODULES, SIZE_MM, shot_of
from tests.server.vision.pictures import pose, pose_error
from tests.support.label_prints import covered
from tests.support.picture_taking import Shot

PICTURES = 70
EDGES = code_edges(MODULES, SIZE_MM)
PREDICTION_SIGMA = np.array([0.01, 0.01, 0.005, 0.3, 0.3, 0.8])
CHI2_95_OF_SIX = 12.592


def random_place(rng: np.random.Generator, nearest_mm: float, farthest_mm: float) -> Array:
    z = float(rng.uniform(nearest_mm, farthest_mm))
    room = 0.3 * z - 35.0
    tilt = rng.uniform(-8.0, 8.0, 3)
    return pose((*rng.uniform(-room, room, 2), z), tilt)


def focus_blur_px(distance_mm: float) -> float:
    """Of a lens focused at 330 mm; sharper than a pixel there, 1.5 px at 130 mm."""
    return math.hypot(0.6, 310.0 * abs(1 / distance_mm - 1 / 330.0))


@pytest.mark.parametrize(
    ("nearest_mm", "farthest_mm"), [(130.0, 170.0), (170.0, 260.0), (260.0, 400.0)]
)
def test_errors_are_as_large_as_promised(nearest_mm: float, farthest_mm: float) -> None:
    rng = np.random.default_rng(round(nearest_mm))
    distances = []
    for number in range(PICTURES):
        place = random_place(rng, nearest_mm, farthest_mm)
        shot = Shot(
            blur_px=focus_blur_px(place[2, 3]),
            exposure=float(rng.uniform(0.6, 0.95)),
            gradient=(float(rng.uniform(-0.3, 0.3)), float(rng.uniform(-0.3, 0.3))),
        )
        image = shot_of(LABEL, place, shot=shot, seed=number)
        start = perturbed(place, rng.normal(0, PREDICTION_SIGMA))
        fit = fit_edges(image, CAMERA, EDGES, start)
        assert fit is not None
        error = pose_error(fit.T_camera_label, place)
        distances.append(error @ np.linalg.solve(fit.covariance, error))
    assert 0.75 < np.mean(distances) / 6 < 1.18
    assert np.mean(np.array(distances) < CHI2_95_OF_SIX) > 0.90


def test_a_cover_takes_nothing_from_the_honesty_of_the_rest() -> None:
    """Edges beside a cover are off by too little to be outliers and by too much to be believed."""
    rng = np.random.default_rng(3)
    distances = []
    for number in range(40):
        place = random_place(rng, 200.0, 350.0)
        label = covered(LABEL, np.random.default_rng(number), float(rng.uniform(0.0, 0.08)))
        shot = Shot(blur_px=focus_blur_px(place[2, 3]))
        start = perturbed(place, rng.normal(0, PREDICTION_SIGMA))
        fit = fit_edges(shot_of(label, place, shot=shot, seed=number), CAMERA, EDGES, start)
        assert fit is not None
        if fit.inlier_share < 0.82:
            continue  # the gate refuses it
        error = pose_error(fit.T_camera_label, place)
        distances.append(error @ np.linalg.solve(fit.covariance, error))
    assert len(distances) > 20
    print(np.round(distances, 1))
    assert np.mean(np.array(distances) < CHI2_95_OF_SIX) > 0.90
    assert np.median(distances) < 8.0
