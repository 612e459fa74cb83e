"""Edges of a module matrix."""

from __future__ import annotations

import numpy as np
import pytest

from server.vision.fitting.code_edges import MOST_EDGES, MOST_PIECES, code_edges
from twin.qr_label import label_modules


def test_a_single_black_module_has_four_edges_that_point_outwards() -> None:
    modules = np.zeros((3, 3), dtype=np.bool_)
    modules[0, 2] = True  # top right: x in 10..30, y in -30..-10
    edges = code_edges(modules, 60.0)
    assert edges.module_mm == 20.0
    # Few sides are cut into pieces, which lie around the side's middle.
    sides = edges.points_mm.reshape(4, MOST_PIECES, 2)
    assert np.ptp(sides, axis=1).max() == pytest.approx(edges.length_mm * (MOST_PIECES - 1))
    middles, normals = sides.mean(axis=1), edges.normals[::MOST_PIECES]
    found = {(tuple(p.round(9)), tuple(n)) for p, n in zip(middles, normals, strict=True)}
    assert found == {
        ((10.0, -20.0), (-1.0, 0.0)),
        ((30.0, -20.0), (1.0, 0.0)),
        ((20.0, -30.0), (0.0, -1.0)),
        ((20.0, -10.0), (0.0, 1.0)),
    }


def test_edges_lie_between_black_and_white_and_point_to_the_white() -> None:
    modules = label_modules("PLUGPILOT:1:7F3K22Q9")
    count = len(modules)
    edges = code_edges(modules, float(count))  # one module is one millimetre

    def is_black(places: np.ndarray[tuple[int, int], np.dtype[np.float64]]) -> list[bool]:
        cells = np.floor(places + count / 2).astype(int)
        return [bool(np.pad(modules, 1)[y + 1, x + 1]) for x, y in cells]

    assert all(is_black(edges.points_mm - 0.5 * edges.normals))
    assert not any(is_black(edges.points_mm + 0.5 * edges.normals))
    framed = np.pad(modules, 1)
    changes = np.count_nonzero(framed[:, 1:] != framed[:, :-1])
    changes += np.count_nonzero(framed[1:] != framed[:-1])
    assert len(edges.points_mm) == changes


def test_edges_know_how_deep_their_black_and_white_are() -> None:
    modules = np.array([[1, 1, 0, 1], [1, 0, 0, 1], [0, 1, 1, 0], [1, 0, 1, 1]], dtype=np.bool_)
    edges = code_edges(modules, 4.0)  # one module is one millimetre
    framed = np.pad(modules, 2)

    def is_black(places: np.ndarray[tuple[int, int], np.dtype[np.float64]]) -> list[bool]:
        cells = np.floor(places + 4.0).astype(int)
        return [bool(framed[y, x]) for x, y in cells]

    assert edges.deep_black.tolist() == is_black(edges.points_mm - 1.5 * edges.normals)
    assert edges.deep_white.tolist() == [
        not black for black in is_black(edges.points_mm + 1.5 * edges.normals)
    ]
    assert 0 < np.count_nonzero(edges.deep_black) < len(edges.deep_black)


def test_large_codes_are_thinned_evenly() -> None:
    modules = label_modules("x" * 400)
    edges = code_edges(modules, 60.0)
    assert len(edges.points_mm) == MOST_EDGES
    for axis in (0, 1):
        kept = edges.points_mm[edges.normals[:, axis] != 0]
        assert len(kept) > MOST_EDGES / 3
        assert np.abs(kept.mean(axis=0)).max() < 3.0
