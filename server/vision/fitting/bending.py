"""A label that is not flat: a bow or a loose corner, as further unknowns of the fit.

What stands off the label's plane is shifted in the picture along the sight. That is a cubic or
steeper function of the place, which no pose explains; so a bend can be told from a pose, but left
out of the fit it turns the pose by more than the noise would. The label's plane is the one that
touches a bow in the code's middle, and the one of the part that sticks where a corner is loose.

Flat labels are fitted without: unknowns that are not there cost accuracy.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from server.vision.fitting.code_edges import CodeEdges
from server.vision.fitting.edge_profiles import EdgeOffsets
from server.vision.fitting.robust_step import RobustStep
from server.vision.projection import Array

EDGES_FOR_BEND = 300
"""With fewer edges a bend cannot be told from uneven light."""

POSSIBLE = 9.0
"""Of chi^2 with three or four degrees of freedom: below it no bend is worth a closer look, which
one flat picture in seven is given; one in twenty is then taken for a bent one, which costs it some
certainty and nothing else."""

_BOW = 3  # unknowns
_CREASES = (-0.5, 0.0, 0.5, 1.0)  # along a diagonal: 0 is the code's middle, 2 its corner

_RIDGE = 1e-9
_NOTHING = 1e-30

_PARTS = 4  # along each side of the code
_EDGES_OF_A_PART = 8
_MOST_BEND_PX = 2.0


def possible_bends(
    solved: RobustStep, measured: EdgeOffsets, edges: CodeEdges, T_camera_label: Array
) -> list[Array]:
    """The kinds of bend there are, where the residuals of a flat fit show any of them.

    Rao's score test in its robust form: the weighted residuals are correlated with what of each
    bend neither pose nor spread explain, relative to how much they scatter.

    Args:
        solved: Last step of the fit without a bend.
        measured: The edges it was made from.
        edges: Edges of the code.
        T_camera_label: Pose, shape (4, 4) [mm].

    Returns:
        Of every kind the derivative of the places along the normals by its unknowns, shape (k, n)
        [px/mm]: where one is significant, another may explain the picture about as well without
        being so; nothing where the label looks flat.
    """
    if len(edges.points_mm) < EDGES_FOR_BEND:
        return []
    # A height shifts a point along the label's z: tau's columns are those of a shift.
    by_height = T_camera_label[:3, 2] @ measured.by_pose[3:]
    bends = by_height * _heights(edges)
    columns = (bends * measured.gain)[:, solved.used]
    weights = solved.weights / solved.scale_px**2
    known = solved.design.T
    weighted = known * weights
    columns -= np.linalg.solve(weighted @ known.T, weighted @ columns.T).T @ known
    scores = columns * (weights * solved.residuals)
    totals, scatter = scores.sum(axis=1), scores @ scores.T
    # Near head-on and far away some unknowns are hardly seen: the ridge keeps them out. In an ideal
    # picture nothing is left of any.
    diagonal = np.diag_indices_from(scatter)
    scatter[diagonal] = scatter[diagonal] * (1 + _RIDGE) + _NOTHING
    corners = [slice(at, at + len(_CREASES)) for at in range(_BOW, len(scores), len(_CREASES))]
    bow = slice(0, _BOW)
    shown = [float(totals[bow] @ np.linalg.solve(scatter[bow, bow], totals[bow]))]
    each = totals[_BOW:].reshape(len(corners), -1, 1)
    solved_each = np.linalg.solve(np.stack([scatter[kind, kind] for kind in corners]), each)
    shown += (each * solved_each).sum(axis=(1, 2)).tolist()
    return [bends[kind] for kind in (bow, *corners)] if max(shown) > POSSIBLE else []


@lru_cache(maxsize=8)
def _heights(edges: CodeEdges) -> Array:
    """Heights of unit bends, shape (19, n) [mm]: three of the bow, four of each corner.

    Paper that is clamped along a crease bends quadratically beyond it; four creases together
    come near to any other.
    """
    x, y = (edges.points_mm / np.abs(edges.points_mm).max()).T
    columns = [x * x, x * y, y * y]
    for right in (-1, 1):
        for down in (-1, 1):
            along = right * x + down * y
            columns += [np.maximum(along - crease, 0.0) ** 2 for crease in _CREASES]
    heights = np.stack(columns)
    heights.flags.writeable = False  # it is shared through the cache
    return heights


def coherent_rest_px(solved: RobustStep, edges: CodeEdges) -> float:
    """Largest mean residual of any part of the code [px].

    Noise and dirt differ from edge to edge; what is bent in no simple way or pasted over does not.
    Residuals are those in the picture's directions, so edges of opposite polarity count with
    opposite signs; parts with few edges do not count.
    """
    parts, signs = _parts(edges)
    part = parts[solved.used]
    shift = np.clip(solved.residuals, -_MOST_BEND_PX, _MOST_BEND_PX) * signs[solved.used]
    counts = np.bincount(part, minlength=2 * _PARTS**2)
    sums = np.bincount(part, weights=shift, minlength=2 * _PARTS**2)
    enough = counts >= _EDGES_OF_A_PART
    return float(np.max(np.abs(sums[enough] / counts[enough]), initial=0.0))


@lru_cache(maxsize=8)
def _parts(edges: CodeEdges) -> tuple[NDArray[np.intp], Array]:
    """Which part and direction each edge belongs to, and which way its white is, shapes (n,)."""
    cell = np.floor((edges.points_mm / np.abs(edges.points_mm).max() + 1) * (_PARTS / 2))
    cell = np.clip(cell, 0, _PARTS - 1).astype(np.intp)
    parts = (cell[:, 0] * _PARTS + cell[:, 1]) * 2 + edges.upright
    signs = edges.normals.sum(axis=1)
    parts.flags.writeable = signs.flags.writeable = False  # they are shared through the cache
    return parts, signs
