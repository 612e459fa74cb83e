"""The planned way of the plug for the 3D picture."""

from __future__ import annotations

import numpy as np
import pytest

from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import gamma
from twin.motion import JointState, MotionLimits, MotionPlan, plan_joint_move
from twin.scene.planned_path import Way, planned_path

GEOMETRY = RobotGeometry()
START, END = JointPosition(120.0, 250.0, 60.0), JointPosition(200.0, 180.0, 130.0)


def plan_to(target: JointPosition) -> MotionPlan:
    return plan_joint_move(MotionLimits(), JointState.at_rest(START), target)


def test_the_way_is_that_of_the_plan() -> None:
    plan = plan_to(END)
    path = planned_path(GEOMETRY, plan)
    assert path is not None
    assert path.duration_s == pytest.approx(plan.duration_s)
    assert path.tips_mm[0] == pytest.approx(tuple(gamma.forward(GEOMETRY, START)))
    assert path.tips_mm[-1] == pytest.approx(tuple(gamma.forward(GEOMETRY, END)), abs=1e-6)
    at = len(path.times_s) // 3
    expected = gamma.forward(GEOMETRY, plan.position_at(float(path.times_s[at])))
    assert path.tips_mm[at] == pytest.approx(tuple(expected), abs=1e-6)
    assert (np.diff(path.times_s) > 0).all()


def test_a_plan_that_moves_nothing_has_no_way() -> None:
    assert planned_path(GEOMETRY, plan_to(START)) is None


def test_the_way_is_worked_out_once_for_each_plan() -> None:
    way, first, second = Way(GEOMETRY), plan_to(END), plan_to(END)
    path = way.of(first)
    assert path is not None
    assert way.of(first) is path
    assert way.of(second) is not path
    assert way.of(None) is None
