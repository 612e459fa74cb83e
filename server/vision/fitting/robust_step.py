"""One robust Gauss-Newton step: weighted least squares over pose and edge spread."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from server.vision.fitting.edge_profiles import EdgeOffsets
from server.vision.fitting.median import median
from server.vision.projection import Array

LEAST_EDGES = 24
_TUKEY = 4.685  # 95% efficient for normal residuals (Beaton and Tukey 1974)
_LEAST_CONTRAST = 0.2  # of the median contrast; below it an edge says nothing
_LEAST_FAINTNESS = 0.7  # no edge counts for much more than the usual ones
_SMALLEST_SCALE_PX = 0.01
_REWEIGHTINGS = 2


@dataclass(frozen=True, slots=True, eq=False)
class RobustStep:
    """Solution of the linear system of one set of measured edges.

    Attributes:
        step: Change of (omega, tau, spread), shape (6 + s,).
        design: Derivative of the residuals by (omega, tau, spread), shape (n, 6 + s).
        residuals: What is left after the step, shape (n,) [px].
        weights: Tukey's weights, shape (n,).
        scale_px: Robust standard deviation of each edge's residual, shape (n,).
        used: Which of the measured edges are in the system.
        efficiency: Mean derivative of Tukey's score, needed for the covariance.
    """

    step: Array
    design: Array
    residuals: Array
    weights: Array
    scale_px: Array
    used: NDArray[np.bool_]
    efficiency: float

    def moved_px(self, unknowns: int | None = None) -> float:
        """How far the first so many unknowns of the step (or all) move the farthest edge."""
        first = slice(unknowns)
        return float(np.max(np.abs(self.design[:, first] @ self.step[first])))

    @property
    def rms_px(self) -> float:
        """Weighted root mean square of what is left."""
        return float(np.sqrt(np.sum(self.weights * self.residuals**2) / np.sum(self.weights)))


def robust_step(
    measured: EdgeOffsets,
    spread_px: Array,
    by_others: Array,
    upright: NDArray[np.bool_],
) -> RobustStep | None:
    """Solve for the step, beginning without weights and then with Tukey's.

    Beginning without is what makes a start far off converge: there, all edges of one direction
    are off alike, and a robust scale would take the other direction alone for the truth. No edge
    can be off by more than its profile, so no outlier can do much harm in the first solution.

    Motion blurs the edges of one direction more than those of the other, so each direction has
    a scale of its own; within it, edges washed out by their neighbours count less.

    Args:
        measured: Edges as the current pose sees them.
        spread_px: Current edge spread at each of them, shape (n,).
        by_others: Its derivative by the numbers that describe it, shape (s, n), and by whatever
            else is unknown.
        upright: Which edges run along the label's y axis, shape (n,).

    Returns:
        The step, or None where too few edges can be used.
    """
    rising = measured.visible & (measured.contrast > 0)
    if np.count_nonzero(rising) < LEAST_EDGES:
        return None
    enough = _LEAST_CONTRAST * median(measured.contrast[rising])
    used = rising & (measured.contrast > enough)
    offsets = (measured.offset_px - spread_px)[used]
    columns = np.concatenate((measured.by_pose, by_others)) * measured.gain
    columns = columns.take(np.flatnonzero(used), axis=1)
    # The error of a centroid is that of the light over the contrast.
    contrast = measured.contrast[used]
    faintness = np.maximum(median(contrast) / contrast, _LEAST_FAINTNESS)
    directions = [np.flatnonzero(way) for way in (upright[used], ~upright[used])]
    weighing = _Weighing(np.ones(len(offsets)), np.ones(len(offsets)), 1.0)
    for number in range(_REWEIGHTINGS + 1):
        weighted = columns * (weighing.weights / weighing.scale_px**2)
        try:
            solution = np.linalg.solve(weighted @ columns.T, weighted @ offsets)
        except np.linalg.LinAlgError:
            return None
        step: Array = np.asarray(solution, dtype=np.float64)
        residuals = offsets - step @ columns
        if number == _REWEIGHTINGS:
            break
        weighed = _weigh(residuals, faintness, directions)
        if weighed is None:
            return None
        weighing = weighed
    return RobustStep(
        step=step,
        design=columns.T,
        residuals=residuals,
        weights=weighing.weights,
        scale_px=weighing.scale_px,
        used=used,
        efficiency=weighing.efficiency,
    )


class _Weighing(NamedTuple):
    """Weights, scales and efficiency as of ``RobustStep``."""

    weights: Array
    scale_px: Array
    efficiency: float


def _weigh(
    residuals: Array, faintness: Array, directions: Sequence[NDArray[np.intp]]
) -> _Weighing | None:
    """Tukey's weights; None where hardly any edge is left."""
    scale_px = np.ones(len(residuals))
    sizes = np.abs(residuals)
    for way in directions:
        if len(way):
            scale = 1.4826 * median(sizes[way] / faintness[way])
            scale_px[way] = max(scale, _SMALLEST_SCALE_PX) * faintness[way]
    rest = np.maximum(1 - (residuals / (_TUKEY * scale_px)) ** 2, 0.0)
    inside = rest > 0
    if np.count_nonzero(inside) < LEAST_EDGES:
        return None
    # Derivative of the score: (1 - q)(1 - 5 q) with q = 1 - rest.
    efficiency = float(rest @ (5 * rest - 4)) / len(residuals)
    return _Weighing(rest * rest, scale_px, max(efficiency, 0.2))
