"""A label that bulges and a robot that sags do not pass for another robot."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from server.calibration.robot import solve
from server.calibration.robot.common_effects import EFFECTS, common_effects, lines_of_sight
from tests.server.calibration.robot.built import DRAWN, R_DRAWN, Workshop

PLACES = np.array([[560.0, 250.0], [650.0, 335.0], [741.0, 390.0], [900.0, 600.0]])
LABEL = np.array([[80.0, 40.0, 290.0], [0.0, 0.0, 290.0], [-60.0, 70.0, 300.0], [5.0, -9.0, 280.0]])


def test_a_bulge_moves_the_label_along_the_line_of_sight_only() -> None:
    found = common_effects(LABEL, PLACES, R_DRAWN, DRAWN.regular_box)
    sight = lines_of_sight(LABEL)
    across = np.cross(sight[:, None], np.swapaxes(found[:, :, :5], 1, 2))
    np.testing.assert_allclose(across, 0.0, atol=1e-12)
    np.testing.assert_allclose(
        found[1, :, :5], 0.0, atol=1e-12, err_msg="straight before the camera"
    )


def test_a_sag_that_is_the_same_everywhere_moves_all_looks_alike() -> None:
    found = common_effects(LABEL, PLACES, R_DRAWN, DRAWN.regular_box)
    lower = found[:, :, 7:].sum(axis=2)
    np.testing.assert_allclose(lower, np.tile(R_DRAWN.T @ [0.0, 1.0, 0.0], (4, 1)), atol=1e-12)


def test_a_bulging_label_bends_the_robot_less_than_if_it_were_flat(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    robots = [Workshop.sagging(seed, 0.002) for seed in range(12)]
    solved_for = [_error_mm(robot) for robot in robots]
    monkeypatch.setattr(solve, "effect_sigmas", lambda _: np.full(EFFECTS, 1e-7))
    taken_for_chance = [_error_mm(robot) for robot in robots]
    assert np.median(solved_for) < 0.06
    assert np.median(taken_for_chance) > 2 * np.median(solved_for)


def _error_mm(robot: Workshop) -> float:
    """What the calibrated platform misses in 95 % of the box; it comes to rest exactly."""
    one = replace(robot, rng=np.random.default_rng(1))
    found = solve.solve_robot(one.looks(), DRAWN, R_DRAWN, one.known)
    return float(np.percentile(one.error_mm(found.unknowns.built), 95))
