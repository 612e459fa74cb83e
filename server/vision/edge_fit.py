"""Least squares fit of the label's pose to every module edge of its code."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.vision.code_edges import CodeEdges
from server.vision.edge_profiles import MOST_REACH_PX, EdgeOffsets, edge_offsets
from server.vision.projection import Array, perturbed

MOST_ITERATIONS = 12
PATIENCE = 8
"""After so many iterations a fit that still swings a little is good enough: perfectly sharp edges
snap from pixel to pixel."""
DEPTH_FLOOR = 2.5e-5
"""Relative error of the distance that noise does not explain: the fall-off of the light across
the picture pulls all edges a little towards its middle (measured on rendered pictures)."""

TILT_FLOOR_RAD = 5e-5
"""The same for the tilt about the picture's axes [rad]."""

_TUKEY = 4.685  # 95% efficient for normal residuals (Beaton and Tukey 1974)
_LEAST_CONTRAST = 0.2  # of the median contrast; below it an edge says nothing
_SMALLEST_SCALE_PX = 0.01
_CONVERGED_PX = 2e-3
_SETTLED_PX = 0.05
_NARROW_BELOW_PX = 0.2
_NARROW_WIDTHS = 3.0
_LEAST_REACH_PX = 2.0


@dataclass(frozen=True, slots=True, eq=False)
class EdgeFit:
    """Result of the fit.

    Attributes:
        T_camera_label: Pose, shape (4, 4), translation [mm].
        covariance: Of (omega, tau) as server.vision.projection defines them, shape (6, 6).
        rms_px: Root mean square distance of the inlying edges from the fit [px].
        inlier_share: Share of the edges that agree with the fit, 0 to 1.
        edge_count: Number of edges looked at.
        spread_px: Outward shift of all black areas by ink, blur and gamma [px].
    """

    T_camera_label: Array
    covariance: Array
    rms_px: float
    inlier_share: float
    edge_count: int
    spread_px: float


def fit_edges(
    image: NDArray[np.uint8],
    camera: CameraModel,
    edges: CodeEdges,
    T_start: Array,
    *,
    inverted: bool = False,
) -> EdgeFit | None:
    """Gauss-Newton over six pose numbers and the edge spread, with Tukey's weights.

    The spread is the seventh unknown because ink, blur and gamma move all black/white edges
    apart; without it a dark picture looks like a nearer label.

    Args:
        image: Grey values, shape (height, width).
        camera: Intrinsics and distortion.
        edges: Edges of the code.
        T_start: Start pose, within about half a module of the truth, shape (4, 4) [mm].
        inverted: The code is white on black.

    Returns:
        The fit, or None where too few edges are visible or the fit does not settle.
    """
    pose, reach_px = T_start, MOST_REACH_PX
    measured = edge_offsets(image, camera, edges, pose, inverted=inverted)
    # Without a first guess of the spread all edges of a well predicted pose would be outliers.
    spread = float(np.median(measured.offset_px))
    for iteration in range(MOST_ITERATIONS):
        system = _weigh(measured, spread)
        if system is None:
            return None
        step = system.step()
        pose = perturbed(pose, step[:6])
        spread += float(step[6])
        moved_px = float(np.max(np.abs(system.design @ step)))
        if not moved_px < MOST_REACH_PX or pose[2, 3] <= 0:
            return None
        if moved_px < (_CONVERGED_PX if iteration < PATIENCE else _SETTLED_PX):
            return _result(system, pose, spread, len(edges.points_mm))
        if moved_px < _NARROW_BELOW_PX and reach_px == MOST_REACH_PX:
            # Longer profiles than the blur only collect noise and slopes of the light.
            reach_px = max(_NARROW_WIDTHS * measured.width_px, _LEAST_REACH_PX)
        measured = edge_offsets(
            image, camera, edges, pose, inverted=inverted, spread_px=spread, reach_px=reach_px
        )
    return None


@dataclass(frozen=True, slots=True, eq=False)
class _System:
    """The weighted linear system of one iteration.

    Attributes:
        design: Derivative of the residuals by (omega, tau, spread), shape (n, 7).
        residuals: Measured minus predicted distance along the normal, shape (n,) [px].
        weights: Tukey's weights, shape (n,).
        efficiency: Mean derivative of Tukey's score, needed for the covariance.
    """

    design: Array
    residuals: Array
    weights: Array
    efficiency: float

    def step(self) -> Array:
        """Weighted least squares solution, shape (7,)."""
        normal = (self.design.T * self.weights) @ self.design
        right = self.design.T @ (self.weights * self.residuals)
        return np.asarray(np.linalg.lstsq(normal, right)[0], dtype=np.float64)

    @property
    def rms_px(self) -> float:
        return float(np.sqrt(np.sum(self.weights * self.residuals**2) / np.sum(self.weights)))

    def covariance(self) -> Array:
        """Sandwich covariance of an M-estimator (Huber 1981, 7.6), pose part, shape (6, 6)."""
        inverse = np.linalg.inv(self.design.T @ self.design * self.efficiency)
        scores = self.weights * self.residuals
        count = len(scores)
        middle = (self.design.T * scores**2) @ self.design * (count / (count - 7))
        return np.asarray((inverse @ middle @ inverse)[:6, :6])


def _result(system: _System, pose: Array, spread_px: float, edge_count: int) -> EdgeFit:
    covariance = system.covariance()
    covariance[(0, 1), (0, 1)] += TILT_FLOOR_RAD**2
    covariance[5, 5] += (DEPTH_FLOOR * pose[2, 3]) ** 2
    return EdgeFit(
        T_camera_label=pose,
        covariance=covariance,
        rms_px=system.rms_px,
        inlier_share=float(np.sum(system.weights > 0.1)) / edge_count,
        edge_count=edge_count,
        spread_px=spread_px,
    )


def _weigh(measured: EdgeOffsets, spread: float) -> _System | None:
    """Build the system from the edges with enough contrast; None if they are too few."""
    rising = measured.visible & (measured.contrast > 0)
    if np.count_nonzero(rising) < 24:
        return None
    enough = _LEAST_CONTRAST * float(np.median(measured.contrast[rising]))
    used = rising & (measured.contrast > enough)
    residuals = measured.offset_px[used] - spread
    design = np.column_stack((measured.by_pose[used], np.ones(len(residuals))))
    scale = 1.4826 * float(np.median(np.abs(residuals)))
    relative = residuals / (_TUKEY * max(scale, _SMALLEST_SCALE_PX))
    weights = np.where(np.abs(relative) < 1, (1 - relative**2) ** 2, 0.0)
    if np.count_nonzero(weights) < 24:
        return None
    inside = relative[np.abs(relative) < 1] ** 2
    efficiency = float(np.sum((1 - inside) * (1 - 5 * inside))) / len(residuals)
    return _System(design, residuals, weights, max(efficiency, 0.2))
