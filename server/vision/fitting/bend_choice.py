"""Which of several kinds of bend a label has, and how far that is in doubt.

A corner that is loose from beyond the middle on looks much like the opposite corner being loose:
the label is creased, and which of its parts is the plane is not easily seen. The two put the plane
at quite different tilts, each with a small covariance of its own. So the doubt between kinds is a
part of the covariance: each counts by its Akaike weight (Burnham and Anderson 2002, 2.9 and 4.3).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from server.vision.fitting.robust_step import RobustStep
from server.vision.projection import Array

_FLAT_PRIOR = 6.0  # 2 ln 20: one label in twenty is bent
_MOST_REST = 25.0  # of an edge, in squared standard deviations


class BendChoice(NamedTuple):
    """What explains a picture best, a flat label included.

    Attributes:
        by_heights: Derivative of the places along the normals by the unknowns of the bend, shape
            (k, n) [px/mm]; None for a flat label.
        doubt: Second moment of (omega, tau) of all others about this one's, by their weights,
            shape (6, 6).
    """

    by_heights: Array | None
    doubt: Array


class _Tried(NamedTuple):
    bend: Array | None
    solved: RobustStep
    penalty: float


def chosen_bend(
    bends: Sequence[Array], flat: RobustStep, solve: Callable[[Array], RobustStep | None]
) -> BendChoice:
    """Solve with each kind of bend, and compare what they leave with what a flat label does.

    Args:
        bends: Of each kind the derivative by its unknowns, shape (k, n) [px/mm].
        flat: Last step without a bend.
        solve: Solves for the same step with the unknowns of a bend besides.
    """
    tried = [_Tried(None, flat, 0.0)]
    for bend in bends:
        solved = solve(bend)
        if solved is not None:
            tried.append(_Tried(bend, solved, 2 * len(bend) + _FLAT_PRIOR))
    # One scale for all, that of the best: what does not fit thinks the noise larger.
    scale_px = min((one.solved for one in tried), key=lambda solved: solved.rms_px).scale_px
    criteria = np.array([_rest(one.solved, scale_px) + one.penalty for one in tried])
    best = int(np.argmin(criteria))
    weights = np.exp((criteria[best] - criteria) / 2)
    weights /= weights.sum()
    steps = np.array([one.solved.step[:6] for one in tried])
    apart = steps - steps[best]
    return BendChoice(tried[best].bend, (apart.T * weights) @ apart)


def _rest(solved: RobustStep, scale_px: Array) -> float:
    """Sum of squared residuals in standard deviations, outliers counting as such."""
    return float(np.sum(np.minimum((solved.residuals / scale_px) ** 2, _MOST_REST)))
