"""The two poses that explain four corners, told apart by the edges.

A plane seen from afar looks nearly the same when its tilt is turned round. The edges tell the
difference by the keystone: the far side of the label looks smaller.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.vision.errors import AmbiguousTiltError, FitFailedError
from server.vision.fitting.code_edges import CodeEdges
from server.vision.fitting.edge_fit import Approach, EdgeFit, approach, finish
from server.vision.fitting.light_picture import light_around
from server.vision.projection import Array, rotation_vector

SAME_POSE_RAD = math.radians(1.0)
"""Two starts that lead to poses turned by less than this lead to the same pose."""

CLEARLY_WORSE = 1.6
"""Ratio of the coarse residuals beyond which only the better pose is fitted to the end."""

LEAST_EVIDENCE = 25.0
"""Smallest n ln(rms2^2 / rms1^2), twice the logarithm of the likelihood ratio of normal errors."""

BENT_SHARE = 0.1
"""The residuals must differ by more than this share of what a bent label does to them: the
likelihood ratio knows noise only."""

_PLAIN_KEYSTONE_PX = 1.5
_PLAIN_RESIDUAL = 0.2


def fit_best(
    image: NDArray[np.uint8],
    camera: CameraModel,
    edges: CodeEdges,
    starts: Sequence[Array],
    *,
    inverted: bool = False,
    moving: bool = False,
) -> EdgeFit:
    """Fit from every start, best first, and keep the pose that the edges prefer.

    Args:
        image: Grey values, shape (height, width).
        camera: Intrinsics and distortion.
        edges: Edges of the code.
        starts: Start poses, at least one, shape (4, 4) each [mm].
        inverted: The code is white on black.
        moving: Something moves: see ``fit_edges``.

    Raises:
        FitFailedError: no start leads to a pose.
        AmbiguousTiltError: two poses explain the picture equally well.
    """
    picture = light_around(image, camera, starts[0], edges)
    near: list[Approach] = []
    for start in starts:
        came = approach(picture, camera, edges, start, inverted=inverted)
        if came is None or any(_is_same(came, other) for other in near):
            continue
        near.append(came)
        if is_plain(camera, came.T_camera_label, came.rms_px, edges):
            near = [came]
            break
    near.sort(key=lambda came: came.rms_px)
    near = [came for came in near if came.rms_px <= CLEARLY_WORSE * near[0].rms_px]
    fits = [finish(picture, camera, edges, came, inverted=inverted, moving=moving) for came in near]
    found = sorted((fit for fit in fits if fit is not None), key=lambda fit: fit.rms_px)
    if not found:
        raise FitFailedError("Too few edges are visible, or the fit does not settle.")
    best = found[0]
    for other in found[1:]:
        if turn_rad(best.T_camera_label, other.T_camera_label) < SAME_POSE_RAD:
            continue
        evidence = 2 * best.edge_count * math.log(other.rms_px / best.rms_px)
        excess_px2 = other.rms_px**2 - best.rms_px**2
        if evidence < LEAST_EVIDENCE or excess_px2 < BENT_SHARE * best.bow_px**2:
            detail = "The label may be tilted one way or the other: the picture fits both."
            raise AmbiguousTiltError(detail, evidence=round(evidence, 1))
    return best


def _is_same(one: Approach, other: Approach) -> bool:
    return turn_rad(one.T_camera_label, other.T_camera_label) < SAME_POSE_RAD


def turn_rad(one: Array, other: Array) -> float:
    """Angle of the rotation from one pose to another, both shape (4, 4)."""
    return float(np.linalg.norm(rotation_vector(one[:3, :3] @ other[:3, :3].T)))


def is_plain(camera: CameraModel, pose: Array, rms_px: float, edges: CodeEdges) -> bool:
    """Whether the opposite tilt would have left far larger residuals than a pose does.

    Turning the tilt round moves a corner by about 2 f (size / 2)^2 sin(tilt) / z^2.
    """
    sight = pose[:3, 3] / np.linalg.norm(pose[:3, 3])
    sine = float(np.linalg.norm(np.cross(sight, pose[:3, 2])))
    half_mm = float(np.abs(edges.points_mm).max())
    keystone_px = 2 * camera.fx * half_mm**2 * sine / float(pose[2, 3]) ** 2
    return keystone_px > _PLAIN_KEYSTONE_PX and rms_px < _PLAIN_RESIDUAL * keystone_px
