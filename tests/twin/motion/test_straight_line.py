from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given

from tests.twin.motion.bounds import assert_derivatives_agree, assert_sample_agrees, assert_within
from tests.twin.strategies import between, default_tips, straightness_mm
from twin.geometry import RobotGeometry
from twin.joints import JointPosition, TipPosition
from twin.kinematics import UnreachableError, forward, forward_many, inverse
from twin.motion import (
    InvalidMotionError,
    JointState,
    MotionLimits,
    PlanningError,
    minimum_time_s,
    plan_straight_line,
)

DEFAULT = RobotGeometry()
UNEVEN = RobotGeometry(e1y_mm=30, e2y_mm=-20)
LIMITS = MotionLimits()
HERE = JointPosition(150, 200, 60)


def tip_along_axis(travel_mm: float) -> TipPosition:
    axis = np.array(DEFAULT.insertion_axis)
    return TipPosition(*(np.array(forward(DEFAULT, HERE)) + travel_mm * axis).tolist())


@given(default_tips(), default_tips(), between(0.1, 1))
def test_lines_are_straight_and_keep_the_limits(
    start_tip: TipPosition, target_tip: TipPosition, speed: float
) -> None:
    assume(math.dist(start_tip, target_tip) > 0.01)
    limits = LIMITS.scaled(speed)
    for geometry in (DEFAULT, UNEVEN):
        start = inverse(geometry, start_tip)
        plan = plan_straight_line(geometry, limits, start, target_tip)
        assert_within(plan, limits)
        tips = forward_many(geometry, plan.sample(np.linspace(0, plan.duration_s, 200)).position_mm)
        assert straightness_mm(tips, start_tip, target_tip) < 1e-6
        assert plan.start == JointState.at_rest(start)
        assert plan.end == JointState.at_rest(inverse(geometry, target_tip))
        nearly = plan.position_at(plan.duration_s * (1 - 1e-9))
        assert nearly == pytest.approx(plan.end.position, abs=1e-5)


@given(default_tips(), default_tips())
def test_straightness_costs_little_time(start_tip: TipPosition, target_tip: TipPosition) -> None:
    start = inverse(DEFAULT, start_tip)
    plan = plan_straight_line(DEFAULT, LIMITS, start, target_tip)
    fastest_s = minimum_time_s(LIMITS, start, inverse(DEFAULT, target_tip))
    assert fastest_s - 1e-9 <= plan.duration_s <= 1.5 * fastest_s + 0.01


@pytest.mark.parametrize("travel_mm", [0.001, 0.1, 2.0, 40.0, 90.0])
def test_a_move_of_the_slide_alone_is_as_fast_as_the_slide(travel_mm: float) -> None:
    plan = plan_straight_line(DEFAULT, LIMITS, HERE, tip_along_axis(travel_mm))
    alone = HERE._replace(rho3_mm=HERE.rho3_mm + travel_mm)
    assert plan.duration_s == pytest.approx(minimum_time_s(LIMITS, HERE, alone), rel=1e-7)
    assert plan.end.position == pytest.approx(alone, abs=1e-9)
    positions = plan.sample(np.linspace(0, plan.duration_s, 100)).position_mm
    np.testing.assert_allclose(positions[:, :2], np.tile(HERE[:2], (100, 1)), atol=1e-9)


def test_the_speed_of_the_tip_can_be_limited() -> None:
    plan = plan_straight_line(DEFAULT, LIMITS, HERE, tip_along_axis(50), tip_speed_mm_s=5)
    # the ramps of 5 mm/s take 2 sqrt(5 / 1500) s
    assert plan.duration_s == pytest.approx(50 / 5 + 2 * math.sqrt(5 / 1500))
    speeds = plan.sample(np.linspace(0, plan.duration_s, 300)).velocity_mm_s[:, 2]
    assert speeds.max() == pytest.approx(5)


def test_plans_are_consistent() -> None:
    target = TipPosition(720, 240, 260)
    plan = plan_straight_line(DEFAULT, LIMITS, inverse(DEFAULT, TipPosition(580, 380, 220)), target)
    assert_derivatives_agree(plan)
    assert_sample_agrees(plan)


def test_nothing_to_move() -> None:
    plan = plan_straight_line(DEFAULT, LIMITS, HERE, forward(DEFAULT, HERE))
    assert plan.duration_s == 0
    assert plan.position_at(1.0) == pytest.approx(HERE)


def test_a_target_out_of_reach_is_refused() -> None:
    with pytest.raises(UnreachableError, match="rho3 would have to be"):
        plan_straight_line(DEFAULT, LIMITS, HERE, tip_along_axis(95))


@pytest.mark.parametrize("speed", [0.0, -1.0, math.nan, math.inf])
def test_a_speed_that_is_none_is_refused(speed: float) -> None:
    with pytest.raises(InvalidMotionError, match="must be greater than zero"):
        plan_straight_line(DEFAULT, LIMITS, HERE, tip_along_axis(10), tip_speed_mm_s=speed)


def test_a_line_into_the_serial_singularity_is_refused() -> None:
    """With legs of 375 mm V at y = 375 stands exactly above both carriages."""
    geometry = RobotGeometry(leg_length_mm=375, base_width_mm=900, theta_rad=0.0)
    start = inverse(geometry, TipPosition(450, 300, 250))
    with pytest.raises(PlanningError, match="perpendicular to the rail"):
        plan_straight_line(geometry, LIMITS, start, TipPosition(450, 375, 250))
