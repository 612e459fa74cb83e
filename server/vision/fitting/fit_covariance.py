"""How well the edges determine the pose."""

from __future__ import annotations

import numpy as np

from server.vision.fitting.code_edges import CodeEdges
from server.vision.fitting.robust_step import RobustStep
from server.vision.projection import Array

COHERENT_PX = 4e-4
"""What neighbouring edges share and residuals therefore do not show, root mean square [px]: what is
left of the pixel grid, of its interpolation and of the light (measured on rendered pictures)."""

_MOST_LEVERAGE = 0.8


def fit_covariance(solved: RobustStep, edges: CodeEdges) -> Array:
    """Sandwich covariance of an M-estimator (Huber 1981, 7.6), pose part, shape (6, 6).

    Pieces of one side of a module share what is wrong with it, so their scores are summed before
    they are squared (Liang and Zeger 1986). The fit makes residuals smaller than the errors, most
    so where few sides bear much: HC2 of MacKinnon and White (1985) puts that right.

    Args:
        solved: The last step.
        edges: All edges of the code.
        distance_mm: Along the optical axis.
    """
    weighted = solved.design.T / solved.scale_px
    inverse = np.linalg.inv(weighted @ weighted.T * solved.efficiency)
    scores = weighted * (solved.weights * solved.residuals / solved.scale_px)
    leverage = _leverages(weighted, solved.weights)
    side = edges.side[solved.used]
    begins = np.flatnonzero(np.diff(side, prepend=-1))
    if len(begins) < len(side):
        scores = np.add.reduceat(scores, begins, axis=1)
        leverage = np.add.reduceat(leverage, begins)
    # A side that draws the fit towards itself shows too little of its error: divide by 1 - h.
    scores /= 1 - np.minimum(leverage, _MOST_LEVERAGE)
    covariance = np.asarray((inverse @ (scores @ scores.T) @ inverse)[:6, :6])
    normal = solved.design.T @ solved.design / len(solved.design)
    covariance += COHERENT_PX**2 * np.linalg.inv(normal)[:6, :6]
    return covariance


def _leverages(weighted: Array, weights: Array) -> Array:
    """How much of its own error each edge takes out of its residual, (k, n) and (n,) -> (n,)."""
    normal = (weighted * weights) @ weighted.T
    return np.asarray(weights * np.sum((np.linalg.inv(normal) @ weighted) * weighted, axis=0))
