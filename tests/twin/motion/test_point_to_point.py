from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.twin.motion.bounds import (
    assert_derivatives_agree,
    assert_sample_agrees,
    assert_within,
    limit_arrays,
)
from tests.twin.strategies import between, default_joints
from twin.joints import JointAcceleration, JointPosition, JointVelocity
from twin.motion import (
    InvalidMotionError,
    JointLimits,
    JointState,
    MotionLimits,
    minimum_time_s,
    plan_joint_move,
)

LIMITS = MotionLimits()
HERE = JointPosition(100, 200, 100)


def test_time_of_a_long_move_by_hand() -> None:
    """T = S/V + V/A + A/J: 200/80 + 80/400 + 400/4000 = 2.8 s."""
    plan = plan_joint_move(LIMITS, HERE, HERE._replace(rho1_mm=300))
    assert plan.duration_s == pytest.approx(2.8)
    assert plan.velocity_at(1.4) == pytest.approx((80, 0, 0))


def test_time_of_a_short_move_by_hand() -> None:
    """T = 4 (S / 2J)^(1/3): 4 (1/8000)^(1/3) = 0.2 s, with the peak at its middle."""
    plan = plan_joint_move(LIMITS, HERE, HERE._replace(rho2_mm=201))
    assert plan.duration_s == pytest.approx(0.2)
    assert plan.velocity_at(0.1).rho2_mm_s == pytest.approx(10)


def test_joints_arrive_together() -> None:
    plan = plan_joint_move(LIMITS, HERE, JointPosition(110, 300, 100))
    assert plan.duration_s == pytest.approx(
        minimum_time_s(LIMITS, HERE, JointPosition(100, 300, 100))
    )
    just_before = plan.velocity_at(plan.duration_s - 0.02)
    assert just_before.rho1_mm_s > 0.01
    assert just_before.rho2_mm_s > 0.01


def test_nothing_to_move() -> None:
    plan = plan_joint_move(LIMITS, HERE, HERE)
    assert plan.duration_s == 0
    assert plan.state_at(1.0) == JointState.at_rest(HERE)
    assert plan.sample(np.array([0.0, 1.0])).position_mm.tolist() == [list(HERE)] * 2


@given(default_joints(), default_joints(), between(0.05, 1))
def test_moves_keep_their_limits(start: JointPosition, target: JointPosition, speed: float) -> None:
    limits = LIMITS.scaled(speed)
    plan = plan_joint_move(limits, start, target)
    assert_within(plan, limits)
    assert plan.start == JointState.at_rest(start)
    assert plan.end == JointState.at_rest(target)
    assert plan.position_at(plan.duration_s * (1 - 1e-9)) == pytest.approx(target, abs=1e-5)


def test_plans_are_consistent() -> None:
    plan = plan_joint_move(LIMITS, HERE, JointPosition(310, 150, 120))
    assert_derivatives_agree(plan)
    assert_sample_agrees(plan)
    retargeted = plan_joint_move(LIMITS, plan.state_at(0.15), HERE)
    assert_derivatives_agree(retargeted)
    assert_sample_agrees(retargeted)


@given(default_joints(), default_joints(), default_joints(), between(0, 1), between(0, 1))
def test_a_new_target_in_flight_keeps_the_limits(
    start: JointPosition, first: JointPosition, second: JointPosition, when: float, again: float
) -> None:
    plan = plan_joint_move(LIMITS, start, first)
    state = plan.state_at(when * plan.duration_s)
    plan = plan_joint_move(LIMITS, state, second)
    assert plan.state_at(0) == state
    assert_within(plan, LIMITS)
    plan = plan_joint_move(LIMITS, plan.state_at(again * plan.duration_s), start)
    assert_within(plan, LIMITS)
    assert plan.end == JointState.at_rest(start)


def test_slowing_down_in_flight_comes_below_the_new_limits_and_arrives() -> None:
    plan = plan_joint_move(LIMITS, HERE, HERE._replace(rho1_mm=300))
    slow = LIMITS.scaled(0.25)
    slower = plan_joint_move(slow, plan.state_at(1.0), HERE._replace(rho1_mm=300))
    velocity = slower.sample(np.linspace(0, slower.duration_s, 500)).velocity_mm_s[:, 0]
    assert velocity[0] == pytest.approx(80)
    assert velocity.max() == pytest.approx(80)
    # v / a + a / j = 60/100 + 100/1000 s of braking, then never above 20 mm/s again
    after = slower.sample(np.linspace(0.75, slower.duration_s, 500)).velocity_mm_s[:, 0]
    assert after.max() <= 20 * (1 + 1e-9)
    assert slower.end.position.rho1_mm == 300


@given(
    st.tuples(*[between(-14, 2)] * 3),
    st.tuples(*[st.sampled_from([-1.2, -1.0, -1e-9, 0.0, 1 - 1e-12, 1 + 1e-12])] * 3),
    st.tuples(*[st.sampled_from([-1.2, -1.0, 0.0, 1e-9, 0.5, 1.0])] * 3),
)
def test_tiny_steps_and_starts_on_or_above_the_limits_are_planned(
    magnitudes: tuple[float, ...], speeds: tuple[float, ...], gains: tuple[float, ...]
) -> None:
    velocity, acceleration, _ = limit_arrays(LIMITS)
    start = JointState(
        HERE,
        JointVelocity(*(velocity * speeds).tolist()),
        JointAcceleration(*(acceleration * gains).tolist()),
    )
    target = JointPosition(*(np.array(HERE) + 10.0 ** np.array(magnitudes)).tolist())
    plan = plan_joint_move(LIMITS, start, target)
    assert plan.position_at(plan.duration_s * (1 - 1e-9)) == pytest.approx(target, abs=1e-5)


def test_a_start_that_the_solver_finds_no_synchronised_motion_for() -> None:
    """Speeds a rounding above the limit: solved with limits smaller by a millionth."""
    start = JointState(
        JointPosition(144.41545493550748, 300.7554852786042, 117.83675287433807),
        JointVelocity(-80.00000000008001, -80.00000000008001, 14.0),
        JointAcceleration(4e-07, 4e-07, 50.0),
    )
    target = JointPosition(144.4154549355075, 300.7554852786042, 117.8221497380097)
    plan = plan_joint_move(LIMITS, start, target)
    assert plan.end.position == target
    assert plan.state_at(0) == start


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_numbers_that_are_not_finite_are_refused(value: float) -> None:
    with pytest.raises(InvalidMotionError, match="not finite"):
        plan_joint_move(LIMITS, HERE, HERE._replace(rho3_mm=value))
    with pytest.raises(InvalidMotionError, match="not finite"):
        plan_joint_move(LIMITS, JointState(HERE, JointVelocity(0, value, 0)), HERE)


def test_a_slower_joint_makes_the_move_longer() -> None:
    target = HERE._replace(rho1_mm=300)
    slow = MotionLimits(rho1=JointLimits(velocity_mm_s=40, acceleration_mm_s2=400, jerk_mm_s3=4000))
    # 200/40 + 40/400 + 400/4000, but 40 mm/s are reached before 400 mm/s^2: 5 + 2 sqrt(40/4000)
    assert minimum_time_s(slow, HERE, target) == pytest.approx(5.2)
