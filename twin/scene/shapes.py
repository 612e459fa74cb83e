"""Triangle meshes from a few solids: lofts, plates, lathes and tubes. All lengths in mm.

The browser computes the normals by averaging over the triangles that share a vertex. So a
shared vertex makes a round surface and a repeated vertex makes an edge; the solids here share
vertices around a ring and repeat them from one ring to the next.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from twin.scene.state import Pose

Points = NDArray[np.float64]

_LEAST_AREA_MM2 = 1e-9


@dataclass(frozen=True, slots=True)
class Mesh:
    """Triangles.

    Attributes:
        vertices_mm: Shape (N, 3).
        faces: Vertex numbers, anticlockwise seen from outside, shape (M, 3).
        uv: Texture coordinates, origin at the picture's top left, shape (N, 2), or None.
        alpha: Opacity of each vertex 0..1, shape (N,), or None for opaque.
    """

    vertices_mm: Points
    faces: NDArray[np.uint32]
    uv: Points | None = None
    alpha: Points | None = None

    def moved(self, offset_mm: ArrayLike) -> Mesh:
        """The mesh shifted by a vector."""
        return Mesh(self.vertices_mm + np.asarray(offset_mm), self.faces, self.uv, self.alpha)

    def turned(self, rotation: NDArray[np.float64]) -> Mesh:
        """The mesh turned by a rotation matrix, shape (3, 3)."""
        return Mesh(self.vertices_mm @ rotation.T, self.faces, self.uv, self.alpha)

    def placed(self, transform: Pose) -> Mesh:
        """The mesh in the frame that a homogeneous transform maps to."""
        return self.turned(transform[:3, :3]).moved(transform[:3, 3])


def merged(meshes: Sequence[Mesh]) -> Mesh:
    """Several meshes of one material as one; all of them have texture coordinates or none has."""
    counts = np.cumsum([0, *(len(m.vertices_mm) for m in meshes)])
    faces = [m.faces + np.uint32(n) for m, n in zip(meshes, counts, strict=False)]
    alpha = uv = None
    if any(m.alpha is not None for m in meshes):
        alpha = np.concatenate(
            [np.ones(len(m.vertices_mm)) if m.alpha is None else m.alpha for m in meshes]
        )
    if all(m.uv is not None for m in meshes):
        uv = np.concatenate([m.uv for m in meshes if m.uv is not None])
    return Mesh(np.concatenate([m.vertices_mm for m in meshes]), np.concatenate(faces), uv, alpha)


def without_waste(mesh: Mesh) -> Mesh:
    """The same mesh without triangles that have no area and vertices that nothing uses."""
    a, b, c = (mesh.vertices_mm[mesh.faces[:, i]] for i in range(3))
    kept = np.linalg.norm(np.cross(b - a, c - a), axis=1) > _LEAST_AREA_MM2
    used, faces = np.unique(mesh.faces[kept], return_inverse=True)
    return Mesh(
        mesh.vertices_mm[used],
        faces.reshape(-1, 3).astype(np.uint32),
        None if mesh.uv is None else mesh.uv[used],
        None if mesh.alpha is None else mesh.alpha[used],
    )


def _roundness(radius_mm: float) -> int:
    """Corners of a circle that looks round at its size."""
    return int(np.clip(4 * round(1.1 * math.sqrt(radius_mm)), 10, 40))


def circle(radius_mm: float, count: int = 40) -> Points:
    """Corners of a regular polygon, anticlockwise, shape (count, 2)."""
    angles = np.arange(count) * 2 * math.pi / count
    return radius_mm * np.column_stack([np.cos(angles), np.sin(angles)])


def rounded_rectangle(width_mm: float, height_mm: float, radius_mm: float) -> Points:
    """Outline about the origin, anticlockwise, shape (N, 2).

    A sharp corner has one point, a small one three, a large one five.
    """
    points = 1 if radius_mm < 2 else 3 if radius_mm < 12 else 5
    corners = []
    for quarter, (sx, sy) in enumerate([(1, 1), (-1, 1), (-1, -1), (1, -1)]):
        middle = (sx * (width_mm / 2 - radius_mm), sy * (height_mm / 2 - radius_mm))
        part = np.linspace(0, math.pi / 2, points) if points > 1 else np.array([math.pi / 4])
        angles = quarter * math.pi / 2 + part
        corners.append(middle + radius_mm * np.column_stack([np.cos(angles), np.sin(angles)]))
    return np.concatenate(corners)


def around(discs: Sequence[tuple[float, float, float]]) -> Points:
    """Convex outline around discs (x, y, radius), anticlockwise, shape (N, 2).

    Andrew's monotone chain over points on the circles.
    """
    points = np.concatenate([circle(r, 24) + np.array([x, y]) for x, y, r in discs])
    ordered = sorted({(float(x), float(y)) for x, y in np.round(points, 6)})

    def chain(sequence: list[tuple[float, float]]) -> list[tuple[float, float]]:
        hull: list[tuple[float, float]] = []
        for p in sequence:
            while len(hull) > 1:
                (ax, ay), (bx, by) = hull[-2], hull[-1]
                if (bx - ax) * (p[1] - ay) - (by - ay) * (p[0] - ax) > 0:
                    break
                hull.pop()
            hull.append(p)
        return hull[:-1]

    return np.array(chain(ordered) + chain(ordered[::-1]))


def inset(outline: Points, by_mm: float) -> Points:
    """A convex outline moved inwards along the bisectors of its corners."""
    edges = np.roll(outline, -1, axis=0) - outline
    normals = np.column_stack([-edges[:, 1], edges[:, 0]])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    bisectors = normals + np.roll(normals, 1, axis=0)
    bisectors /= np.linalg.norm(bisectors, axis=1, keepdims=True)
    return np.asarray(outline + by_mm * bisectors)


def _ring(outline: Points, z_mm: float) -> Points:
    return np.column_stack([outline, np.full(len(outline), z_mm)])


def _band(first: Points, second: Points) -> Mesh:
    """The strip between two closed rings of equally many points, normals outwards.

    A ring that is one point becomes one vertex.
    """
    n = len(first)
    i = np.arange(n)
    j = (i + 1) % n
    low_i, low_j, high_i, high_j = i, j, i + n, j + n
    if not np.ptp(first, axis=0).any():
        low_i = low_j = np.zeros(n, dtype=int)
    if not np.ptp(second, axis=0).any():
        high_i = high_j = np.full(n, n)
    faces = np.concatenate(
        [np.column_stack([low_i, low_j, high_j]), np.column_stack([low_i, high_j, high_i])]
    )
    return Mesh(np.concatenate([first, second]), faces.astype(np.uint32))


def cap(ring: Points) -> Mesh:
    """A fan over a convex ring, facing the side from which it runs anticlockwise."""
    n = len(ring)
    i = np.arange(n)
    faces = np.column_stack([np.full(n, n), i, (i + 1) % n])
    return Mesh(np.concatenate([ring, ring.mean(axis=0)[None]]), faces.astype(np.uint32))


def loft(rings: Sequence[Points], *, closed: bool = True) -> Mesh:
    """A skin over closed rings (N, 3), with an edge at each ring, capped at both ends."""
    parts = [_band(a, b) for a, b in itertools.pairwise(rings)]
    if closed:
        parts += [cap(rings[0][::-1]), cap(rings[-1])]
    return merged(parts)


def plate(outline: Points, thickness_mm: float, *, chamfer_mm: float = 2.0) -> Mesh:
    """A convex outline made solid from z = 0 to the thickness, with chamfered edges."""
    c = min(chamfer_mm, thickness_mm / 3)
    inner = inset(outline, c)
    return loft(
        [
            _ring(inner, 0.0),
            _ring(outline, c),
            _ring(outline, thickness_mm - c),
            _ring(inner, thickness_mm),
        ]
    )


def block(size_mm: tuple[float, float, float], *, radius_mm: float = 4.0) -> Mesh:
    """A box about the origin with rounded corners in x-y and chamfered ends in z."""
    width, height, depth = size_mm
    radius = min(radius_mm, width / 2.5, height / 2.5)
    solid = plate(rounded_rectangle(width, height, radius), depth, chamfer_mm=radius_mm / 2)
    return solid.moved((0, 0, -depth / 2))


def lathe(profile: Sequence[tuple[float, float]], *, count: int | None = None) -> Mesh:
    """A solid or bowl turned about z from (radius, z) points, with an edge at each point."""
    corners = count or _roundness(max(r for r, _ in profile))
    rings = [_ring(circle(r, corners), z) for r, z in profile]
    return loft(rings, closed=False)


def rod(
    radius_mm: float, length_mm: float, *, chamfer_mm: float = 1.0, count: int | None = None
) -> Mesh:
    """A cylinder from z = 0 to its length, with chamfered ends."""
    c, r = min(chamfer_mm, length_mm / 3, radius_mm / 2), radius_mm
    return lathe(
        [(0, 0), (r - c, 0), (r, c), (r, length_mm - c), (r - c, length_mm), (0, length_mm)],
        count=count,
    )


def disc(radius_mm: float, height_mm: float) -> Mesh:
    """The upper end of a cylinder: its side and its face, for what nobody sees from below."""
    return lathe([(radius_mm, 0), (radius_mm, height_mm), (0, height_mm)])


def sweep(path_mm: Points, radius_mm: float, *, count: int = 12) -> Mesh:
    """A round tube along a path in a plane that is not parallel to (1, 0, 0), shape (N, 3)."""
    tangents = np.gradient(path_mm, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    side = np.cross(tangents, (1.0, 0.0, 0.0))
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    other = np.cross(tangents, side)
    ring = circle(radius_mm, count)
    points = (
        path_mm[:, None] + ring[None, :, :1] * side[:, None] + ring[None, :, 1:] * other[:, None]
    )
    n = len(path_mm)
    i = np.arange((n - 1) * count).reshape(n - 1, count)
    j = np.roll(i, -1, axis=1)
    quads = [i.ravel(), j.ravel(), (j + count).ravel(), (i + count).ravel()]
    a, b, c, d = quads
    faces = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    skin = Mesh(points.reshape(-1, 3), faces.astype(np.uint32))
    return merged([skin, cap(points[0][::-1]), cap(points[-1])])


def quad(width_mm: float, height_mm: float) -> Mesh:
    """A textured rectangle about the origin, facing +z, the picture upright along +y."""
    w, h = width_mm / 2, height_mm / 2
    vertices = np.array([[-w, -h, 0], [w, -h, 0], [w, h, 0], [-w, h, 0]], dtype=float)
    uv = np.array([[0, 1], [1, 1], [1, 0], [0, 0]], dtype=float)
    return Mesh(vertices, np.array([[0, 1, 2], [0, 2, 3]], dtype=np.uint32), uv)


def rounded_curve(points: Points, per_span: int) -> Points:
    """More points on a smooth curve through given ones (Catmull-Rom), shape (N, D)."""
    padded = np.vstack([2 * points[0] - points[1], points, 2 * points[-1] - points[-2]])
    t = (np.arange(per_span) / per_span)[:, None]
    spans = [
        0.5
        * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t**2 + (d - a + 3 * (b - c)) * t**3)
        for a, b, c, d in zip(padded, padded[1:], padded[2:], padded[3:], strict=False)
    ]
    return np.vstack([*spans, points[-1:]])


def grid(points_mm: Points, alpha: Points | None = None) -> Mesh:
    """A round skin over a grid of points (R, C, 3), opacity (R, C).

    It faces the side from which the rows run upwards when the columns run to the right.
    """
    rows, columns, _ = points_mm.shape
    i = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = i[:-1, :-1], i[:-1, 1:], i[1:, 1:], i[1:, :-1]
    triangles = [np.stack([a, b, c], -1), np.stack([a, c, d], -1)]
    faces = np.concatenate([t.reshape(-1, 3) for t in triangles]).astype(np.uint32)
    return Mesh(points_mm.reshape(-1, 3), faces, alpha=None if alpha is None else alpha.ravel())
