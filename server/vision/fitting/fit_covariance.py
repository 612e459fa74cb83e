"""How well the edges determine the pose."""

from __future__ import annotations

import numpy as np

from server.vision.projection import Array
from server.vision.fitting.robust_step import RobustStep

DEPTH_FLOOR = 2.5e-5
TILT_FLOOR_RAD = 5e-5


def fit_covariance(solved: RobustStep, points_mm: Array, pose: Array) -> Array:
    """Sandwich covariance of an M-estimator (Huber 1981, 7.6), pose part, shape (6, 6)."""
    inverse = np.linalg.inv(solved.design.T @ solved.design * solved.efficiency)
    scores = solved.weights * solved.residuals
    count = len(scores)
    middle = (solved.design.T * scores**2) @ solved.design * (count / (count - solved.design.shape[1]))
    covariance = np.asarray((inverse @ middle @ inverse)[:6, :6])
    covariance[(0, 1), (0, 1)] += TILT_FLOOR_RAD**2
    covariance[5, 5] += (DEPTH_FLOOR * pose[2, 3]) ** 2
    return covariance
