"""Least squares fit of the label's pose to every module edge of its code."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.vision.fitting.bending import coherent_rest_px
from server.vision.fitting.code_edges import CodeEdges, thinned
from server.vision.fitting.edge_profiles import MOST_REACH_PX, EdgeOffsets, edge_offsets
from server.vision.fitting.fine_fit import FineFit
from server.vision.fitting.fit_covariance import fit_covariance
from server.vision.fitting.light_picture import LightPicture, light_around
from server.vision.fitting.robust_step import RobustStep, robust_step
from server.vision.projection import Array, perturbed

COARSE_EDGES = 200
"""So many edges lead from the start to the neighbourhood of the fit; then all of them count."""
COARSE_REACH_PX = 40.0
"""The start may be off by half a module; those of a tag nearby are large."""
MOST_COARSE_STEPS = 5
MOST_FINE_STEPS = 12
PATIENCE, SETTLED_PX = 5, 0.1
"""After so many fine steps a fit that still swings by no more than this is good enough: perfectly
sharp edges snap from pixel to pixel."""

_NEAR_PX, _NEAR_MODULES = 1.0, 0.25
"""After a coarse step as short as the larger of the two, the next would not come nearer."""

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
        bend_px: Largest shift of an edge because the label is bent, as the fit has it [px].
        solved: The last step ...
        measured: ... and the edges that it was made from.
    """

    T_camera_label: Array
    covariance: Array
    rms_px: float
    inlier_share: float
    edge_count: int
    spread_px: float
    bow_px: float
    bend_px: float
    solved: RobustStep
    measured: EdgeOffsets


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
    alike = np.ones((1, len(few.points_mm)))
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
        solved = robust_step(measured, spread_px * alike[0], alike, few.upright)
        if solved is None or not solved.moved_px() < COARSE_REACH_PX:
            return None
        pose, spread_px = perturbed(pose, solved.step[:6]), spread_px + float(solved.step[6])
        if pose[2, 3] <= 0:
            return None
        near = Approach(pose, solved.rms_px, spread_px, few, measured)
        module_px = camera.fx * edges.module_mm / float(pose[2, 3])
        if solved.moved_px() < max(_NEAR_PX, _NEAR_MODULES * module_px):
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
    fine = FineFit(
        picture,
        camera,
        edges,
        near.T_camera_label,
        spread_px=near.spread_px,
        few=near.few,
        measured=near.measured,
        inverted=inverted,
        moving=moving,
    )
    for number in range(MOST_FINE_STEPS):
        stepped = fine.step()
        if stepped is None:
            return None
        solved, moved_px = stepped
        if not moved_px < MOST_REACH_PX:
            return None
        short_px = fine.short_px if number < PATIENCE else SETTLED_PX
        if moved_px <= short_px and not fine.learn(solved):
            return _result(solved, fine, edges)
    return None


def _result(solved: RobustStep, fine: FineFit, edges: CodeEdges) -> EdgeFit:
    """Pose, covariance and what the gates want to know of the last step."""
    edge_count = len(edges.points_mm)
    bow_px = coherent_rest_px(solved, edges)
    if fine.before_cover is not None:  # what comes off or is pasted over looks like a cover, too
        bow_px = max(bow_px, coherent_rest_px(fine.before_cover, edges))
    covariance = fit_covariance(solved, edges)
    if fine.bend_doubt is not None:
        covariance += fine.bend_doubt
    return EdgeFit(
        T_camera_label=fine.pose,
        covariance=covariance,
        rms_px=solved.rms_px,
        inlier_share=fine.inlier_share(solved),
        edge_count=edge_count,
        spread_px=fine.spread_px,
        bow_px=bow_px,
        bend_px=fine.bend_px,
        solved=solved,
        measured=fine.measured,
    )
