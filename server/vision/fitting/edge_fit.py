"""Least squares fit of the label's pose to every module edge of its code."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.vision.fitting.blurred_code import BlurredCode
from server.vision.fitting.code_edges import CodeEdges, thinned
from server.vision.fitting.edge_profiles import MOST_REACH_PX, EdgeOffsets, edge_offsets
from server.vision.fitting.edge_spread import spread_basis
from server.vision.fitting.fit_covariance import fit_covariance
from server.vision.fitting.light_field import light_field
from server.vision.fitting.light_picture import LightPicture, light_around
from server.vision.fitting.measured_blur import blurred_as_seen
from server.vision.fitting.robust_step import RobustStep, robust_step
from server.vision.projection import Array, perturbed

COARSE_EDGES = 200
"""So many edges lead from the start to the neighbourhood of the fit; then all of them count."""
COARSE_REACH_PX = 40.0
"""The start may be off by half a module; those of a tag nearby are large."""
MOST_COARSE_STEPS = 5
MOST_FINE_STEPS = 8
PATIENCE = 5
"""After so many fine steps a fit that still swings a little is good enough: perfectly sharp edges
snap from pixel to pixel."""

BLUR_LOOKS = 2
"""So often the blur of a blurred picture is measured, each time at a better pose."""

_NEAR_PX = 2.0
_CONVERGED_PX = 0.05
_SETTLED_PX = 0.1
_PROFILE_WIDTHS = 3.0
_LEAST_REACH_PX = 2.0

_FLOWING_MODULES = 0.18
"""Blur (standard deviation across the edges of one direction) from which on neighbours count."""

_PARTS = 4  # along each side of the code
_EDGES_OF_A_PART = 8
_MOST_BOW_PX = 2.0

Image = NDArray[np.uint8]


@dataclass(frozen=True, slots=True, eq=False)
class EdgeFit:
    """Result of the fit.

    Attributes:
        T_camera_label: Pose, shape (4, 4), translation [mm].
        covariance: Of (omega, tau) as server.vision.projection defines them, shape (6, 6).
        rms_px: Root mean square distance of the inlying edges from the fit [px].
        inlier_share: Share of the edges that agree with the fit, 0 to 1.
        edge_count: Number of edges looked at.
        spread_px: Outward shift of black areas in the code's middle by ink, blur and gamma [px].
        bow_px: Largest mean distance of the edges in any part of the code from the fit [px].
    """

    T_camera_label: Array
    covariance: Array
    rms_px: float
    inlier_share: float
    edge_count: int
    spread_px: float
    bow_px: float


@dataclass(frozen=True, slots=True, eq=False)
class Approach:
    """Where the coarse steps lead: close enough for all edges and short profiles.

    Attributes:
        T_camera_label: Pose, shape (4, 4), translation [mm].
        rms_px: Root mean square distance of the inlying edges [px].
        spread_px: Edge spread, the same everywhere.
        few: The edges that were looked at.
        measured: What was measured of them.
    """

    T_camera_label: Array
    rms_px: float
    spread_px: float
    few: CodeEdges
    measured: EdgeOffsets


def fit_edges(
    image: Image,
    camera: CameraModel,
    edges: CodeEdges,
    T_start: Array,
    *,
    inverted: bool = False,
    moving: bool = False,
) -> EdgeFit | None:
    """Gauss-Newton over six pose numbers and the edge spread, with Tukey's weights.

    The spread is unknown because ink, blur and gamma move all black/white edges apart; without
    it a dark picture looks like a nearer label.

    Args:
        image: Grey values, shape (height, width).
        camera: Intrinsics and distortion.
        edges: Edges of the code.
        T_start: Start pose, within about half a module of the truth, shape (4, 4) [mm].
        inverted: The code is white on black.
        moving: Label or camera moves while the sensor reads row by row, which shears the label:
            its way per row is unknown, too, and the pose is that of the picture's middle row.

    Returns:
        The fit, or None where too few edges are visible or the fit does not settle.
    """
    picture = light_around(image, camera, T_start, edges)
    near = approach(picture, camera, edges, T_start, inverted=inverted)
    if near is None:
        return None
    return finish(picture, camera, edges, near, inverted=inverted, moving=moving)


def approach(
    picture: LightPicture,
    camera: CameraModel,
    edges: CodeEdges,
    T_start: Array,
    *,
    inverted: bool = False,
) -> Approach | None:
    """Steps with few edges and long profiles, until a step is short.

    Arguments as of ``fit_edges``, with the light around the label. Returns None where that leads
    nowhere.
    """
    few = thinned(edges, COARSE_EDGES)
    pose, spread_px = T_start, 0.0
    alike = np.ones((len(few.points_mm), 1))
    near: Approach | None = None
    for _ in range(MOST_COARSE_STEPS):
        measured = edge_offsets(
            picture,
            camera,
            few,
            pose,
            inverted=inverted,
            spread_px=spread_px,
            reach_px=COARSE_REACH_PX,
        )
        solved = robust_step(measured, spread_px * alike[:, 0], alike, few.upright)
        if solved is None or not solved.moved_px < COARSE_REACH_PX:
            return None
        pose, spread_px = perturbed(pose, solved.step[:6]), spread_px + float(solved.step[6])
        if pose[2, 3] <= 0:
            return None
        near = Approach(pose, solved.rms_px, spread_px, few, measured)
        if solved.moved_px < _NEAR_PX:
            break
    return near


def finish(
    picture: LightPicture,
    camera: CameraModel,
    edges: CodeEdges,
    near: Approach,
    *,
    inverted: bool = False,
    moving: bool = False,
) -> EdgeFit | None:
    """Steps with all edges, profiles as short as the blur allows, and the light taken out.

    Arguments as of ``fit_edges``, with the light around the label. Returns None where the fit does
    not settle.
    """
    pose, basis = near.T_camera_label, spread_basis(edges)
    spread = np.zeros(basis.shape[1])
    spread[0] = near.spread_px
    row_way = np.zeros(2)
    # Longer profiles than the blur only collect noise.
    reach_px = max(_PROFILE_WIDTHS * near.measured.width_px(), _LEAST_REACH_PX)
    light = light_field(near.few, near.measured)
    levels = None if light is None else light.levels(edges)
    expected: BlurredCode | None = None
    looks = 0 if light is not None and _neighbours_flow_in(near, camera) else BLUR_LOOKS
    for number in range(MOST_FINE_STEPS):
        spread_px = basis @ spread
        measured = edge_offsets(
            picture,
            camera,
            edges,
            pose,
            inverted=inverted,
            spread_px=spread_px,
            reach_px=reach_px,
            levels=levels,
            row_way=row_way,
            expected=expected,
        )
        others = np.column_stack((basis, measured.by_row_way)) if moving else basis
        solved = robust_step(measured, spread_px, others, edges.upright)
        if solved is None or not solved.moved_px < MOST_REACH_PX:
            return None
        pose = perturbed(pose, solved.step[:6])
        spread = spread + solved.step[6 : 6 + len(spread)]
        if moving:
            row_way = row_way + solved.step[-2:]
        if solved.moved_px < (_CONVERGED_PX if number < PATIENCE else _SETTLED_PX):
            if looks < BLUR_LOOKS:
                light = light_field(edges, measured)
            if looks == BLUR_LOOKS or light is None:
                return _result(solved, pose, float(spread[0]), edges)
            looks += 1
            levels = light.levels(edges)
            expected = blurred_as_seen(
                picture, camera, edges, pose, light, inverted=inverted, row_way=row_way
            )
    return None


def _neighbours_flow_in(near: Approach, camera: CameraModel) -> bool:
    """Whether blur or motion carry the light of one module's edges to those of the next."""
    module_px = camera.fx * near.few.module_mm / float(near.T_camera_label[2, 3])
    upright = near.few.upright
    widest_px = max(near.measured.width_px(upright), near.measured.width_px(~upright))
    return widest_px > _FLOWING_MODULES * module_px


def _result(solved: RobustStep, pose: Array, spread_px: float, edges: CodeEdges) -> EdgeFit:
    """Pose, covariance and what the gates want to know of the last step."""
    edge_count = len(edges.points_mm)
    return EdgeFit(
        T_camera_label=pose,
        covariance=fit_covariance(solved, edges, float(pose[2, 3])),
        rms_px=solved.rms_px,
        inlier_share=float(np.sum(solved.weights > 0.1)) / edge_count,
        edge_count=edge_count,
        spread_px=spread_px,
        bow_px=_bow_px(solved, edges),
    )


def _bow_px(solved: RobustStep, edges: CodeEdges) -> float:
    """Coherent residuals: noise and dirt differ from edge to edge, a bent label does not.

    Residuals are those in the picture's directions, so edges of opposite polarity count with
    opposite signs; parts with few edges do not count.
    """
    place = edges.points_mm[solved.used]
    cell = np.floor((place / np.abs(edges.points_mm).max() + 1) * (_PARTS / 2))
    cell = np.clip(cell, 0, _PARTS - 1).astype(np.intp)
    upright = edges.upright[solved.used]
    part = (cell[:, 0] * _PARTS + cell[:, 1]) * 2 + upright
    sign = edges.normals[solved.used].sum(axis=1)
    shift = np.clip(solved.residuals, -_MOST_BOW_PX, _MOST_BOW_PX) * sign
    counts = np.bincount(part, minlength=2 * _PARTS**2)
    sums = np.bincount(part, weights=shift, minlength=2 * _PARTS**2)
    enough = counts >= _EDGES_OF_A_PART
    return float(np.max(np.abs(sums[enough] / counts[enough]), initial=0.0))
