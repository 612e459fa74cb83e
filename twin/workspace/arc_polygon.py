"""Regions of the plane whose boundary is made of circular arcs and segments, exactly."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from twin.workspace.boundary import Arc, Array, Loop, Piece, Point
from twin.workspace.errors import EmptyRegionError


class Extent(NamedTuple):
    """Smallest axis-parallel rectangle that holds a region [mm]."""

    x_min_mm: float
    x_max_mm: float
    y_min_mm: float
    y_max_mm: float


@dataclass(frozen=True, slots=True)
class ArcPolygon:
    """A closed region: the points inside its loops, which neither cross nor contain each other.

    All figures are closed forms of the arcs; nothing is sampled.
    """

    loops: tuple[Loop, ...]

    @property
    def is_empty(self) -> bool:
        """Whether the region has no inner points."""
        return not self.loops

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """All pieces of all loops."""
        return tuple(piece for loop in self.loops for piece in loop)

    @property
    def vertices(self) -> tuple[Point, ...]:
        """Where two pieces meet, in the order of the loops."""
        return tuple(piece.start for piece in self.pieces)

    @property
    def area_mm2(self) -> float:
        """Area by Green's theorem [mm^2]."""
        return 0.5 * math.fsum(piece.twice_area_mm2 for piece in self.pieces)

    @property
    def perimeter_mm(self) -> float:
        """Length of the boundary [mm]."""
        return math.fsum(piece.length_mm for piece in self.pieces)

    @property
    def extent(self) -> Extent:
        """Smallest axis-parallel rectangle around the region [mm].

        Raises:
            EmptyRegionError: the region has no points.
        """
        if self.is_empty:
            msg = "the region is empty and has no extent"
            raise EmptyRegionError(msg)
        points = [*self.vertices, *(p for piece in self.pieces for p in _sideways_extremes(piece))]
        xs, ys = zip(*points, strict=True)
        return Extent(min(xs), max(xs), min(ys), max(ys))

    def contains(self, x_mm: float, y_mm: float) -> bool:
        """Whether a point lies in the region; rounding decides on the boundary itself."""
        return bool(self.contains_many(np.array([x_mm, y_mm])))

    def contains_many(self, points_mm: Array) -> NDArray[np.bool_]:
        """Whether points lie in the region: an odd number of pieces lies to their right.

        Args:
            points_mm: Shape (..., 2).

        Returns:
            Shape (...); False for NaN.
        """
        x, y = points_mm[..., 0], points_mm[..., 1]
        inside = np.zeros(x.shape, dtype=np.bool_)
        for piece in self.pieces:
            low, high = sorted((piece.start.y_mm, piece.end.y_mm))
            # half open, so that a ray through a vertex counts it once
            beside = (low <= y) & (y < high)
            if low < high:
                inside ^= beside & (x < piece.x_at(np.where(beside, y, low)))
        return inside

    def chord(self, y_mm: float) -> tuple[float, float] | None:
        """Leftmost and rightmost x of the region at a height; None where it has no points."""
        found = [
            float(piece.x_at(np.array(y_mm)))
            for piece in self.pieces
            if piece.start.y_mm != piece.end.y_mm
            and (y_mm - piece.start.y_mm) * (y_mm - piece.end.y_mm) <= 0
        ]
        return (min(found), max(found)) if found else None

    def polylines(self, sagitta_mm: float = 0.05) -> list[Array]:
        """One closed line per loop, for drawing.

        Args:
            sagitta_mm: Largest distance of a chord from its arc. Vertices are exact.

        Returns:
            Arrays of shape (N, 2) whose last point is the first [mm].
        """
        lines = []
        for loop in self.loops:
            parts = [piece.points(_points_needed(piece, sagitta_mm))[:-1] for piece in loop]
            lines.append(np.concatenate([*parts, parts[0][:1]]))
        return lines

    def translated(self, dx_mm: float, dy_mm: float) -> ArcPolygon:
        """The same region elsewhere."""
        return ArcPolygon(
            tuple(tuple(piece.translated(dx_mm, dy_mm) for piece in loop) for loop in self.loops)
        )


def _sideways_extremes(piece: Piece) -> list[Point]:
    """The leftmost or rightmost point of the circle, if the piece passes through it."""
    if not isinstance(piece, Arc):
        return []
    x_mm, y_mm = piece.center.x_mm + piece.side * piece.radius_mm, piece.center.y_mm
    low, high = sorted((piece.start.y_mm, piece.end.y_mm))
    return [Point(x_mm, y_mm)] if low < y_mm < high else []


def _points_needed(piece: Piece, sagitta_mm: float) -> int:
    if not isinstance(piece, Arc):
        return 2
    # a chord over the angle a lies r (1 - cos(a / 2)) from its arc
    step = 2 * math.acos(max(1 - sagitta_mm / piece.radius_mm, 0.0))
    return 1 + max(1, math.ceil(abs(piece.end_rad - piece.start_rad) / step))
