"""Which edges lie beside something that covers a part of the code."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from server.vision.fitting.code_edges import code_edges
from server.vision.fitting.covered_edges import EDGES_FOR_COVER, covered_edges
from server.vision.fitting.robust_step import RobustStep
from server.vision.markers.april_tags import tag_modules
from tests.server.vision.label_shots import MODULES, SIZE_MM

EDGES = code_edges(MODULES, SIZE_MM)
COUNT = len(EDGES.points_mm)


def step_rejecting(rejected: NDArray[np.bool_], seen: NDArray[np.bool_]) -> RobustStep:
    """A step that gives no weight to some edges, of those that are seen at all."""
    count = int(np.count_nonzero(seen))
    return RobustStep(
        step=np.zeros(7),
        design=np.zeros((count, 7)),
        residuals=np.zeros(count),
        weights=np.where(rejected, 0.0, 1.0)[seen],
        scale_px=np.ones(count),
        used=seen,
        efficiency=1.0,
    )


def test_around_a_cover_edges_are_left_out_and_elsewhere_they_are_not() -> None:
    seen = np.ones(COUNT, dtype=np.bool_)
    right = EDGES.points_mm[:, 0].max()
    hidden = EDGES.points_mm[:, 0] > right - 2.2 * EDGES.module_mm
    covered = covered_edges(EDGES, step_rejecting(hidden, seen))
    assert covered is not None
    beside = EDGES.points_mm[:, 0] > right - 3.0 * EDGES.module_mm
    assert np.mean(covered[beside & ~hidden]) > 0.8
    far = EDGES.points_mm[:, 0] < right - 3.7 * EDGES.module_mm
    assert not covered[far].any()


def test_what_is_not_seen_is_rejected_too() -> None:
    hidden = EDGES.points_mm[:, 1] > EDGES.points_mm[:, 1].max() - 2.2 * EDGES.module_mm
    rejected = step_rejecting(hidden, np.ones(COUNT, dtype=np.bool_))
    unseen = step_rejecting(np.zeros(COUNT, dtype=np.bool_), ~hidden)
    one, other = covered_edges(EDGES, rejected), covered_edges(EDGES, unseen)
    assert one is not None
    assert other is not None
    np.testing.assert_array_equal(one, other)


def test_outliers_here_and_there_are_no_cover() -> None:
    seen = np.ones(COUNT, dtype=np.bool_)
    for seed in range(30):
        rejected = np.random.default_rng(seed).random(COUNT) < 0.05
        assert covered_edges(EDGES, step_rejecting(rejected, seen)) is None


def test_the_pieces_of_a_tags_sides_are_side_by_side_by_nature() -> None:
    tag = code_edges(tag_modules("tag36h11:17"), SIZE_MM)
    count = len(tag.points_mm)
    assert count < EDGES_FOR_COVER
    every = np.ones(count, dtype=np.bool_)
    rejected = tag.points_mm[:, 0] > 0
    assert covered_edges(tag, step_rejecting(rejected, every)) is None
