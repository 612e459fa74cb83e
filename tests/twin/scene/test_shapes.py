"""Solids: closed, facing outwards, of the right size."""

from __future__ import annotations

import math

import numpy as np
import pytest

from twin.scene import shapes
from twin.scene.shapes import Mesh


def volume_of(mesh: Mesh) -> float:
    """Signed volume; negative when the faces look inwards (divergence theorem)."""
    a, b, c = (mesh.vertices_mm[mesh.faces[:, i]] for i in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def is_closed(mesh: Mesh) -> bool:
    """Every edge between two places belongs to as many triangles one way as the other."""
    keys = [tuple(v) for v in np.round(mesh.vertices_mm, 5)]
    balance: dict[tuple[object, object], int] = {}
    for face in mesh.faces:
        for i, j in ((0, 1), (1, 2), (2, 0)):
            a, b = keys[face[i]], keys[face[j]]
            if a == b:
                continue
            edge, way = ((a, b), 1) if a < b else ((b, a), -1)
            balance[edge] = balance.get(edge, 0) + way
    return not any(balance.values())


SOLIDS = {
    "rod": (shapes.rod(10, 50, chamfer_mm=0.01, count=200), math.pi * 100 * 50),
    "block": (shapes.block((30, 20, 10), radius_mm=0.02), 30 * 20 * 10),
    "plate": (shapes.plate(shapes.circle(20, 200), 8, chamfer_mm=0.01), math.pi * 400 * 8),
    "ring": (
        shapes.lathe([(10, 0), (20, 0), (20, 5), (10, 5), (10, 0)], count=200),
        math.pi * 300 * 5,
    ),
    "hull": (
        shapes.plate(shapes.around([(0, 0, 10), (100, 0, 10)]), 4, chamfer_mm=0.01),
        (100 * 20 + math.pi * 100) * 4,
    ),
    "tube": (
        shapes.sweep(
            np.column_stack([np.zeros(9), np.zeros(9), np.linspace(0, 80, 9)]), 5, count=90
        ),
        math.pi * 25 * 80,
    ),
}


@pytest.mark.parametrize("name", SOLIDS)
def test_a_solid_is_closed_and_holds_its_volume(name: str) -> None:
    mesh, volume = SOLIDS[name]
    assert is_closed(mesh)
    assert volume_of(mesh) == pytest.approx(volume, rel=0.01)


def test_an_outline_moved_inwards_keeps_its_distance() -> None:
    inner = shapes.inset(shapes.rounded_rectangle(100, 60, 10), 5)
    assert np.abs(inner).max(axis=0) == pytest.approx([45, 25], abs=0.2)


def test_moving_turning_and_joining_keep_the_solid() -> None:
    rod = shapes.rod(10, 50)
    turned = rod.turned(np.array([[0, -1.0, 0], [1, 0, 0], [0, 0, 1]])).moved((5, 6, 7))
    both = shapes.merged([rod, turned])
    assert volume_of(turned) == pytest.approx(volume_of(rod))
    assert volume_of(both) == pytest.approx(2 * volume_of(rod))
    assert turned.vertices_mm.mean(axis=0) == pytest.approx(
        np.add(rod.vertices_mm.mean(axis=0), (5, 6, 7))
    )


def test_opacity_survives_joining_with_an_opaque_mesh() -> None:
    faint = Mesh(np.zeros((3, 3)), np.array([[0, 1, 2]], dtype=np.uint32), alpha=np.full(3, 0.5))
    joined = shapes.merged([faint, shapes.rod(1, 1, count=8)])
    assert joined.alpha is not None
    assert joined.alpha[:4].tolist() == [0.5, 0.5, 0.5, 1.0]


def test_a_smooth_curve_goes_through_its_points() -> None:
    points = np.array([[0.0, 0], [1, 2], [3, 1], [4, 4]])
    curve = shapes.rounded_curve(points, 5)
    assert curve[::5] == pytest.approx(points)


def test_a_grid_faces_the_side_from_which_it_runs_right_and_up() -> None:
    x, y = np.meshgrid([0.0, 1, 2], [0.0, 1])
    mesh = shapes.grid(np.stack([x, y, np.zeros_like(x)], axis=-1))
    a, b, c = (mesh.vertices_mm[mesh.faces[:, i]] for i in range(3))
    assert (np.cross(b - a, c - a)[:, 2] > 0).all()
