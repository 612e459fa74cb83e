"""How well the edges determine the pose."""

from __future__ import annotations

import numpy as np

from server.vision.projection import Array
from server.vision.fitting.robust_step import RobustStep

DEPTH_FLOOR = 2.5e-5
"""Relative error of the distance that the residuals do not show: what is left of uneven light and
of the pixel grid (measured on rendered pictures)."""

TILT_FLOOR_RAD = 5e-5
"""The same for the tilt about the picture's axes [rad]."""


def fit_covariance(solved: RobustStep, distance_mm: float) -> Array:
    """Sandwich covariance of an M-estimator (Huber 1981, 7.6), pose part, shape (6, 6)."""
    weighted = solved.design / solved.scale_px[:, None]
    inverse = np.linalg.inv(weighted.T @ weighted * solved.efficiency)
    scores = weighted * (solved.weights * solved.residuals / solved.scale_px)[:, None]
    count, unknowns = scores.shape
    middle = scores.T @ scores * (count / (count - unknowns))
    covariance = np.asarray((inverse @ middle @ inverse)[:6, :6])
    covariance[(0, 1), (0, 1)] += TILT_FLOOR_RAD**2
    covariance[5, 5] += (DEPTH_FLOOR * distance_mm) ** 2
    return covariance
