"""A limit switch that has moved is told from a robot that is built otherwise."""

from __future__ import annotations

import pytest

from server.calibration.robot.moved_switch import moved_switch_mm
from tests.server.calibration.robot.built import Workshop


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("by_mm", [-4.0, 1.5])
def test_a_moved_switch_is_measured(seed: int, by_mm: float) -> None:
    robot = Workshop.robot(seed)
    then = robot.built.model_copy(update={"right_foot_x_mm": robot.built.right_foot_x_mm - by_mm})
    found = moved_switch_mm(robot.looks(), robot.R_base_camera, then)
    assert found == pytest.approx(by_mm, abs=0.3)


@pytest.mark.parametrize("seed", range(4))
def test_no_switch_is_blamed_where_none_has_moved(seed: int) -> None:
    robot = Workshop.robot(seed)
    looks = robot.looks()
    assert moved_switch_mm(looks, robot.R_base_camera, robot.built) is None
    skewed = robot.built.model_copy(update={"left_rail_rad": robot.built.left_rail_rad + 0.01})
    assert moved_switch_mm(looks, robot.R_base_camera, skewed) is None
