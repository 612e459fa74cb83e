from __future__ import annotations

import numpy as np
import pytest

from twin.study.evolution import Array, Scores, best_of, better, evolve

OPTIMUM = np.array([0.3, 0.8, 0.55])


def bowl(points: Array) -> Scores:
    return Scores(((points - OPTIMUM) ** 2).sum(axis=1), np.zeros(len(points)))


def test_it_finds_the_bottom_of_a_bowl() -> None:
    assert evolve(bowl, 3, seed=1, generations=120) == pytest.approx(OPTIMUM, abs=1e-3)


def test_it_keeps_to_the_edge_of_what_is_allowed() -> None:
    def fenced(points: Array) -> Scores:
        return Scores(points.sum(axis=1), np.maximum(0.5 - points[:, 0] * points[:, 1], 0.0))

    x, y = evolve(fenced, 2, seed=2, generations=150)
    assert (x, y) == pytest.approx((np.sqrt(0.5), np.sqrt(0.5)), abs=1e-2)
    assert x * y >= 0.5


def test_the_same_seed_finds_the_same_point() -> None:
    first, again, other = (evolve(bowl, 3, seed=seed, generations=5) for seed in (3, 3, 4))
    assert np.array_equal(first, again)
    assert not np.array_equal(first, other)


def test_every_generation_is_told() -> None:
    told: list[int] = []
    evolve(bowl, 3, seed=0, generations=7, on_generation=lambda: told.append(1))
    assert len(told) == 7


def test_points_stay_in_the_cube() -> None:
    def seen(points: Array) -> Scores:
        assert points.min() >= 0
        assert points.max() <= 1
        return Scores(-points.sum(axis=1), np.zeros(len(points)))

    assert evolve(seen, 2, seed=5, generations=60) == pytest.approx([1, 1], abs=1e-3)


def test_debs_rules() -> None:
    old = Scores(np.array([1.0, 1.0, 1.0, 1.0]), np.array([0.0, 2.0, 2.0, 0.0]))
    new = Scores(np.array([9.0, 9.0, 0.0, 0.5]), np.array([0.0, 1.0, 3.0, 0.0]))
    assert better(new, old).tolist() == [False, True, False, True]
    assert best_of(Scores(np.array([0.0, 5.0, 4.0]), np.array([1.0, 0.0, 0.0]))) == 2
