"""The planned path."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.twin.scene.overlays.states import EVERYTHING, PATH
from twin.scene import PlannedPath
from twin.scene.overlays.colors import EARLY_TO_LATE
from twin.scene.overlays.path import PIECES, evenly_in_time, length_mm
from twin.scene.scene import TwinScene


def is_visible(scene: TwinScene) -> bool:
    return scene.path.way.visible


def test_points_lie_evenly_in_time_not_in_space() -> None:
    times, tips = evenly_in_time(PATH, 8)
    assert np.diff(times) == pytest.approx(np.full(8, 0.5))
    # x = 600 + 10 t^2, known every 0.1 s: the pieces grow.
    assert tips[:, 0] == pytest.approx(600 + 10 * times**2, abs=0.03)
    assert (np.diff(tips[:, 0], n=2) > 0).all()


def test_it_is_drawn_from_its_start_to_its_end_with_its_time(scene: TwinScene) -> None:
    scene.show(EVERYTHING)
    assert scene.path.way.visible
    line = np.asarray(scene.path.line.points)
    assert line.shape == (PIECES, 2, 3)
    assert line[0, 0] == pytest.approx([0.6, 0.3, 0.2])
    assert line[-1, 1] == pytest.approx([0.76, 0.3, 0.2])
    assert line[1:, 0] == pytest.approx(line[:-1, 1])
    colors = np.asarray(scene.path.line.colors)
    assert tuple(colors[0, 0]) == EARLY_TO_LATE[0]
    assert tuple(colors[-1, 1]) == EARLY_TO_LATE[-1]
    assert scene.path.end.text == "4.0 s, 160 mm"
    assert scene.path.end.position == pytest.approx((0.76, 0.3, 0.2))


def test_it_goes_with_its_plan_and_a_new_plan_is_drawn_anew(scene: TwinScene) -> None:
    scene.show(EVERYTHING)
    assert is_visible(scene)
    scene.show(replace(EVERYTHING, path=None))
    assert not is_visible(scene)
    shorter = PlannedPath(PATH.times_s[:21], PATH.tips_mm[:21])
    scene.show(replace(EVERYTHING, path=shorter))
    assert is_visible(scene)
    assert scene.path.end.text == "2.0 s, 40 mm"


def test_a_plan_that_leads_nowhere_is_not_drawn(scene: TwinScene) -> None:
    still = PlannedPath(np.array([0.0, 1.0]), np.array([[600.0, 300, 200], [600.0, 300.5, 200]]))
    assert length_mm(still) == pytest.approx(0.5)
    scene.show(replace(EVERYTHING, path=still))
    assert not scene.path.way.visible
