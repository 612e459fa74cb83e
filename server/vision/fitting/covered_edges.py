"""Edges beside something that covers a part of the code.

An outlier is seldom alone. What hides some modules reaches into the next ones as well, and shifts
their edges by so little that no robust weight tells: the light of a cover flows into a profile, or
lies at its end. So where several edges close together are rejected, those around them count no
more, however well they seem to fit.
"""

from __future__ import annotations

from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from server.vision.fitting.code_edges import CodeEdges
from server.vision.fitting.robust_step import RobustStep

AGREES = 0.1
"""An edge with a smaller weight is rejected."""

EDGES_FOR_COVER = 300
"""With fewer edges, each the piece of a side, rejected ones are side by side by their nature."""

REJECTED_BESIDE = 2
"""So many rejected edges within a module of another one ..."""

LEAST_TOGETHER = 8
"""... and so many rejected ones of which that is true mean a cover: of a twentieth of all edges
that are rejected by chance, two are so placed."""

_REACH_HALVES = 2  # of a module


def covered_edges(edges: CodeEdges, solved: RobustStep) -> NDArray[np.bool_] | None:
    """Which edges lie beside several rejected ones, shape (n,); None where nothing is covered.

    Args:
        edges: Edges of the code.
        solved: Last step of the fit.
    """
    if len(edges.points_mm) < EDGES_FOR_COVER:
        return None
    rejected = np.ones(len(edges.points_mm), dtype=np.bool_)
    rejected[np.flatnonzero(solved.used)[solved.weights > AGREES]] = False
    if np.count_nonzero(rejected) < LEAST_TOGETHER:
        return None
    row, column = _cells(edges)
    cells = np.zeros((int(row.max()) + 1, int(column.max()) + 1), dtype=np.float32)
    cells[row, column] = rejected
    reach = (2 * _REACH_HALVES + 1, 2 * _REACH_HALVES + 1)
    around = cv2.boxFilter(cells, -1, reach, normalize=False, borderType=cv2.BORDER_CONSTANT)
    beside = np.asarray(around)[row, column] - rejected
    covered = beside > REJECTED_BESIDE - 0.5
    if np.count_nonzero(covered & rejected) < LEAST_TOGETHER:
        return None
    return np.asarray(covered, dtype=np.bool_)


@lru_cache(maxsize=8)
def _cells(edges: CodeEdges) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Row and column of every edge on a grid of half modules, shapes (n,): one edge a cell."""
    cells = np.rint(2 * edges.points_mm / edges.module_mm).astype(np.intp)
    column, row = (cells - cells.min(axis=0)).T
    column.flags.writeable = row.flags.writeable = False  # they are shared through the cache
    return row, column
