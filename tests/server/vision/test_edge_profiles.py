"""Offsets of edges along their normals."""

from __future__ import annotations

import numpy as np
import pytest

from server.vision.fitting.code_edges import code_edges
from server.vision.fitting.edge_profiles import edge_offsets
from server.vision.fitting.light_picture import light_around
from server.vision.projection import perturbed
from tests.server.vision.label_shots import CAMERA, MODULES, PLACE, SIZE_MM, shot_of
from tests.support.picture_taking import Shot

EDGES = code_edges(MODULES, SIZE_MM)


@pytest.mark.parametrize("blur_px", [0.75, 1.2, 1.8])
@pytest.mark.parametrize("axis", [3, 4])
def test_offsets_follow_a_shift_as_far_as_the_gain_says(blur_px: float, axis: int) -> None:
    """A gain that is off by a twentieth makes every last step too long or too short by as much."""
    picture = light_around(shot_of(shot=Shot(blur_px=blur_px)), CAMERA, PLACE, EDGES)
    shift = np.zeros(6)
    shift[axis] = 0.05  # mm, 0.15 px
    here, there = (
        edge_offsets(picture, CAMERA, EDGES, at, reach_px=3 * blur_px)
        for at in (perturbed(PLACE, -shift / 2), perturbed(PLACE, shift / 2))
    )
    moved = here.offset_px - there.offset_px
    expected = (here.gain + there.gain) / 2 * (here.by_pose[axis] * shift[axis])
    across = np.abs(here.by_pose[axis]) > 1.0  # px/mm: the edges that this axis moves
    followed = float(moved[across] @ expected[across]) / float(expected[across] @ expected[across])
    assert followed == pytest.approx(1.0, abs=0.03)
