"""The region between flanks: the exact arrangement of all curves that bound it.

All heights at which two flanks cross, begin or end cut the plane into horizontal slabs. Inside a
slab the order of the flanks from left to right is fixed, so its middle tells which of them bound
the region there, and whether there is any region between them. Runs of slabs with points become
loops. Deciding in the middle of slabs makes tangent and coincident curves harmless: whatever
rounding does to them, it happens in slabs too thin or too narrow to matter.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise
from typing import NamedTuple

from twin.workspace.arc_polygon import ArcPolygon
from twin.workspace.boundary import Limit, Loop, Piece, Segment
from twin.workspace.flank import Flank, crossing_heights

MERGE_MM = 1e-10
"""Heights nearer than this count as one; slabs are at least as thick."""

JOIN_MM = 1e-9
"""Ends of two flanks nearer than this are one vertex; wider gaps are closed by a segment."""


class Band(NamedTuple):
    """Heights between which a region may have points, and what limits them."""

    y_low_mm: float
    y_high_mm: float
    low_limit: Limit
    high_limit: Limit


@dataclass(frozen=True, slots=True)
class _Slab:
    y_low_mm: float
    y_high_mm: float
    left: Flank
    right: Flank


def region_between(
    left: Sequence[Flank], right: Sequence[Flank], bands: Sequence[Band]
) -> ArcPolygon:
    """Points to the right of all left flanks and to the left of all right ones, within bands.

    Args:
        left: At every height of the bands at least one of them must bound.
        right: Likewise.
        bands: Disjoint and ascending.
    """
    loops: list[Loop] = []
    for band in bands:
        loops.extend(_loop(run, band) for run in _runs(left, right, band))
    return ArcPolygon(tuple(loops))


def _runs(left: Sequence[Flank], right: Sequence[Flank], band: Band) -> list[list[_Slab]]:
    """Slabs with points, in groups that hang together, from low to high."""
    runs: list[list[_Slab]] = []
    connected = False
    for low, high in pairwise(_heights([*left, *right], band)):
        middle = 0.5 * (low + high)
        bound_left = max((f for f in left if f.covers(middle)), key=_at(middle))
        bound_right = min((f for f in right if f.covers(middle)), key=_at(middle))
        if bound_left.x_at(middle) >= bound_right.x_at(middle):
            connected = False
            continue
        if connected and bound_right.x_at(low) - bound_left.x_at(low) <= JOIN_MM:
            connected = False  # two parts that touch in one point are two loops
        if not connected:
            runs.append([])
        runs[-1].append(_Slab(low, high, bound_left, bound_right))
        connected = True
    return runs


def _at(y_mm: float) -> Callable[[Flank], float]:
    return lambda flank: flank.x_at(y_mm)


def _heights(flanks: Sequence[Flank], band: Band) -> list[float]:
    """Ascending heights that cut the band into slabs, both its ends among them."""
    if band.y_high_mm - band.y_low_mm < MERGE_MM:
        return []
    found = [y for flank in flanks for y in (flank.y_low_mm, flank.y_high_mm)]
    for one, other in combinations(flanks, 2):
        found.extend(crossing_heights(one, other))
    heights = [band.y_low_mm]
    for y_mm in sorted(y for y in found if band.y_low_mm < y < band.y_high_mm - MERGE_MM):
        if y_mm - heights[-1] >= MERGE_MM:
            heights.append(y_mm)
    return [*heights, band.y_high_mm]


def _loop(run: Sequence[_Slab], band: Band) -> Loop:
    """The boundary of one run: up along its right flanks, down along its left ones."""
    up = _chain([(slab.right, slab.y_low_mm, slab.y_high_mm) for slab in run])
    down = _chain([(slab.left, slab.y_high_mm, slab.y_low_mm) for slab in reversed(run)])
    top = _closing(up[-1], down[0], band.high_limit)
    bottom = _closing(down[-1], up[0], band.low_limit)
    return (*up, *top, *down, *bottom)


def _chain(steps: Sequence[tuple[Flank, float, float]]) -> list[Piece]:
    """Pieces of a flank after another; neighbours on one curve are one piece."""
    joined: list[tuple[Flank, float, float]] = []
    for flank, start, end in steps:
        if joined and joined[-1][0].is_same_curve(flank):
            joined[-1] = (flank, joined[-1][1], end)
        else:
            joined.append((flank, start, end))
    pieces: list[Piece] = []
    for flank, start, end in joined:
        piece = flank.piece(start, end)
        if pieces:
            pieces.extend(_closing(pieces[-1], piece, flank.limit))
        pieces.append(piece)
    return pieces


def _closing(before: Piece, after: Piece, limit: Limit) -> list[Piece]:
    """The segment from one piece to the next, if their ends are apart."""
    segment = Segment(before.end, after.start, limit)
    return [segment] if segment.length_mm > JOIN_MM else []
