"""How black and white change across the label: slope of the light, vignetting, reflections.

A slope of the light along an edge's profile looks like a shift of the edge towards the light, by
slope / contrast times half the squared reach of the profile. All edges shift alike, so no robust
weight notices it; hence the profiles are measured relative to the local black and white.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

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
        half_mm: Unit of the place.
    """

    black: Array
    white: Array
    half_mm: float

    def at(self, points_mm: Array) -> tuple[Array, Array]:
        """Black and contrast at label coordinates, shape (n, 2), never without contrast."""
        basis = _basis(*(points_mm / self.half_mm).T)
        contrast = basis @ (self.white - self.black)
        least = _LEAST_CONTRAST * abs(float(contrast.mean()))
        return basis @ self.black, np.maximum(contrast, least)

    def levels(self, edges: CodeEdges) -> ProfileLevels:
        """Black, contrast and their slopes along the normals at every edge."""
        x, y = (edges.points_mm / self.half_mm).T
        basis = _basis(x, y)
        zero, one = np.zeros_like(x), np.ones_like(x)
        by_x = np.column_stack((zero, one, zero, 2 * x, y, zero))
        by_y = np.column_stack((zero, zero, one, zero, x, 2 * y))
        normals = edges.normals / self.half_mm
        by_normal = by_x * normals[:, :1] + by_y * normals[:, 1:]
        contrast = self.white - self.black
        values = basis @ contrast
        least = _LEAST_CONTRAST * abs(float(values.mean()))
        return ProfileLevels(
            black=basis @ self.black,
            black_per_mm=by_normal @ self.black,
            contrast=np.maximum(values, least),
            contrast_per_mm=by_normal @ contrast,
        )


def light_field(edges: CodeEdges, measured: EdgeOffsets) -> LightField | None:
    """Fit black and white to the ends of the profiles; None where too few edges are visible."""
    good = measured.visible & (measured.contrast > 0)
    if np.count_nonzero(good) < _LEAST_EDGES:
        return None
    half_mm = float(np.abs(edges.points_mm).max())
    x, y = (edges.points_mm[good] / half_mm).T
    basis = _basis(x, y)
    black, white = measured.black[good], measured.white[good]
    return LightField(_surface(basis, black), _surface(basis, white), half_mm)


def _basis(x: Array, y: Array) -> Array:
    return np.column_stack((np.ones_like(x), x, y, x * x, x * y, y * y))


def _surface(basis: Array, values: Array) -> Array:
    """Least squares, repeated without what lies far off."""
    kept = np.ones(len(values), dtype=np.bool_)
    for _ in range(2):
        coefficients = np.linalg.solve(basis[kept].T @ basis[kept], basis[kept].T @ values[kept])
        misses = np.abs(values - basis @ coefficients)
        limit = _OUTLIER_MADS * max(median(misses), 1.0)
        if np.count_nonzero(misses < limit) < _LEAST_EDGES // 2:
            break
        kept = misses < limit
    return np.asarray(coefficients, dtype=np.float64)
