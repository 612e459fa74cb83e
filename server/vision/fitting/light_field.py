"""How black and white change across the label: slope of the light, vignetting, reflections.

A slope of the light along an edge's profile looks like a shift of the edge towards the light, by
slope / contrast times half the squared reach of the profile. All edges shift alike, so no robust
weight notices it; hence the profiles are measured relative to the local black and white.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from server.vision.fitting.code_edges import CodeEdges
from server.vision.fitting.edge_profiles import EdgeOffsets, ProfileLevels
from server.vision.fitting.median import median
from server.vision.projection import Array

_LEAST_EDGES = 40
_OUTLIER_MADS = 4.0
_LEAST_CONTRAST = 0.1  # of the mean contrast; the fields never come nearer to each other


@dataclass(frozen=True, slots=True, eq=False)
class LightField:
    """Grey values of black and of white as quadratic functions of the place on the label.

    Attributes:
        black: Six coefficients of 1, x, y, x^2, xy, y^2 with x and y in units of half_mm.
        white: The same for white.
        half_mm: Unit of the place: half the code's side.
    """

    black: Array
    white: Array
    half_mm: float

    def at(self, points_mm: Array) -> tuple[Array, Array]:
        """Black and contrast at label coordinates, shape (n, 2), never without contrast."""
        basis = _basis(*(points_mm / self.half_mm).T)
        return self.black @ basis, self._contrast(basis)

    def levels(self, edges: CodeEdges) -> ProfileLevels:
        """Black, contrast and their slopes along the normals at every edge."""
        basis, by_normal = _bases(edges)
        return ProfileLevels(
            black=self.black @ basis,
            black_per_mm=self.black @ by_normal,
            contrast=self._contrast(basis),
            contrast_per_mm=(self.white - self.black) @ by_normal,
        )

    def _contrast(self, basis: Array) -> Array:
        contrast = (self.white - self.black) @ basis
        least = _LEAST_CONTRAST * abs(float(contrast.mean()))
        return np.maximum(contrast, least)


def light_field(edges: CodeEdges, measured: EdgeOffsets) -> LightField | None:
    """Fit black and white to the ends of the profiles; None where too few edges are visible.

    Only ends that lie two modules deep in their colour count: others never get quite as dark or as
    bright, but those at the code's border do, and that looks like light that grows outwards.
    """
    good = measured.visible & (measured.contrast > 0)
    if np.count_nonzero(good) < _LEAST_EDGES:
        return None
    return LightField(
        black=_surface(edges, good, edges.deep_black, measured.black),
        white=_surface(edges, good, edges.deep_white, measured.white),
        half_mm=_half_mm(edges),
    )


def _half_mm(edges: CodeEdges) -> float:
    return edges.module_mm * len(edges.modules) / 2


@lru_cache(maxsize=16)
def _bases(edges: CodeEdges) -> tuple[Array, Array]:
    """Basis at the edges and its derivative along their normals [1/mm], both shape (6, n)."""
    half_mm = _half_mm(edges)
    x, y = (edges.points_mm / half_mm).T
    zero, one = np.zeros_like(x), np.ones_like(x)
    by_x = np.stack((zero, one, zero, 2 * x, y, zero))
    by_y = np.stack((zero, zero, one, zero, x, 2 * y))
    normal_x, normal_y = (edges.normals / half_mm).T
    both = _basis(x, y), by_x * normal_x + by_y * normal_y
    for array in both:
        array.flags.writeable = False  # they are shared through the cache
    return both


def _basis(x: Array, y: Array) -> Array:
    return np.stack((np.ones_like(x), x, y, x * x, x * y, y * y))


def _surface(
    edges: CodeEdges, good: NDArray[np.bool_], deep: NDArray[np.bool_], grey: Array
) -> Array:
    """Least squares, repeated without what lies far off."""
    chosen = good & deep
    if np.count_nonzero(chosen) < _LEAST_EDGES:
        chosen = good
    basis, values = _bases(edges)[0][:, chosen], grey[chosen]
    coefficients = np.linalg.solve(basis @ basis.T, basis @ values)
    misses = np.abs(values - coefficients @ basis)
    kept = misses < _OUTLIER_MADS * max(median(misses), 1.0)
    if _LEAST_EDGES // 2 <= np.count_nonzero(kept) < len(values):
        basis = basis[:, kept]
        coefficients = np.linalg.solve(basis @ basis.T, basis @ values[kept])
    return np.asarray(coefficients, dtype=np.float64)
