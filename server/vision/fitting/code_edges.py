"""The black/white edges of a code in label coordinates."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

MOST_EDGES = 800
"""Large codes are thinned to this many edges: enough for the accuracy, and the time stays flat."""

ENOUGH_EDGES = 300
MOST_PIECES = 4
"""Codes of few, large modules have their sides cut into so many pieces, each an edge of its own."""

_USED_OF_SIDE = 0.75  # near the corners of a module other edges count


@dataclass(frozen=True, slots=True, eq=False)
class CodeEdges:
    """Middles of all module sides with black on one side and white on the other.

    Collinear sides are kept one by one: each has a grey profile of its own, so it is a
    measurement of its own, and a wrong module spoils one point and not a whole line.

    Attributes:
        points_mm: Label coordinates x, y (origin the code's centre), shape (n, 2).
        normals: Unit vectors from black to white in the label's plane, shape (n, 2).
        tangents: Unit vectors along the edge, a quarter turn from the normals, shape (n, 2).
        module_mm: Side of one module.
        length_mm: Length of each edge.
        side: Number of the module side that each edge is a piece of, shape (n,).
        deep_black: The next but one module on the black side is black, too, shape (n,).
        deep_white: The same on the white side.
        modules: The code itself, True is black, shape (m, m).
    """

    points_mm: NDArray[np.float64]
    normals: NDArray[np.float64]
    tangents: NDArray[np.float64]
    module_mm: float
    length_mm: float
    side: NDArray[np.intp]
    deep_black: NDArray[np.bool_]
    deep_white: NDArray[np.bool_]
    modules: NDArray[np.bool_]

    @property
    def upright(self) -> NDArray[np.bool_]:
        """Which edges run along the label's y axis, shape (n,)."""
        return np.asarray(self.normals[:, 0] != 0)


@lru_cache(maxsize=16)
def thinned(edges: CodeEdges, most: int) -> CodeEdges:
    """At most so many of the edges, spread evenly over both directions and the whole code."""
    count = len(edges.points_mm)
    if count <= most:
        return edges
    kept = np.linspace(0, count - 1, most).round().astype(np.intp)
    return replace(
        edges,
        points_mm=edges.points_mm[kept],
        normals=edges.normals[kept],
        tangents=edges.tangents[kept],
        side=edges.side[kept],
        deep_black=edges.deep_black[kept],
        deep_white=edges.deep_white[kept],
    )


def code_edges(modules: NDArray[np.bool_], label_size_mm: float) -> CodeEdges:
    """List the edges of a module matrix surrounded by white.

    Args:
        modules: True is black, shape (n, n), row 0 the top row.
        label_size_mm: Outer side of the code without its quiet zone.
    """
    count = modules.shape[0]
    return _code_edges(np.packbits(modules).tobytes(), count, label_size_mm)


@lru_cache(maxsize=8)
def _code_edges(packed: bytes, count: int, label_size_mm: float) -> CodeEdges:
    """The same for a matrix that can be hashed: a camera sees one label again and again."""
    bits = np.unpackbits(np.frombuffer(packed, dtype=np.uint8), count=count * count)
    modules = bits.astype(np.bool_).reshape(count, count)
    modules.flags.writeable = False  # it is shared through the cache
    module_mm = label_size_mm / count
    across = _sides(modules)
    down = _sides(modules.T)
    # _sides speaks of columns; for the transposed matrix x and y change places.
    cells = np.concatenate((across[:, :2], down[:, 1::-1]))
    signs = np.concatenate((across[:, 2], down[:, 2]))
    deep = np.concatenate((across[:, 3:], down[:, 3:])) != 0
    normals = np.zeros_like(cells)
    normals[: len(across), 0] = signs[: len(across)]
    normals[len(across) :, 1] = signs[len(across) :]
    points = cells * module_mm - label_size_mm / 2
    tangents = normals[:, ::-1] * (-1.0, 1.0)
    pieces = int(np.clip(ENOUGH_EDGES // max(len(points), 1), 1, MOST_PIECES))
    length_mm = _USED_OF_SIDE * module_mm / pieces
    along = (np.arange(pieces) - (pieces - 1) / 2) * length_mm
    points = (points[:, None, :] + tangents[:, None, :] * along[:, None]).reshape(-1, 2)
    normals, tangents = normals.repeat(pieces, axis=0), tangents.repeat(pieces, axis=0)
    deep = deep.repeat(pieces, axis=0)
    edges = CodeEdges(
        points_mm=points,
        normals=normals,
        tangents=tangents,
        module_mm=module_mm,
        length_mm=length_mm,
        side=np.arange(len(points)) // pieces,
        deep_black=deep[:, 0],
        deep_white=deep[:, 1],
        modules=modules,
    )
    return thinned(edges, MOST_EDGES)


def _sides(modules: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Sides between neighbouring columns, a row for each.

    The columns are x, y [modules from the top left], direction of white, and whether the black and
    the white are two modules deep.
    """
    black = np.pad(modules, ((0, 0), (2, 2))).astype(np.int8)
    near_left, near_right = black[:, 1:-2], black[:, 2:-1]
    rows, columns = np.nonzero(near_left - near_right)
    to_white = (near_left - near_right)[rows, columns]
    deep_left = (black[:, :-3] == near_left)[rows, columns]
    deep_right = (black[:, 3:] == near_right)[rows, columns]
    deep_black = np.where(to_white > 0, deep_left, deep_right)
    deep_white = np.where(to_white > 0, deep_right, deep_left)
    return np.column_stack((columns, rows + 0.5, to_white, deep_black, deep_white)).astype(
        np.float64
    )
