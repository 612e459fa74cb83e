from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given

from tests.twin.motion.bounds import assert_sample_agrees, assert_within
from tests.twin.strategies import between, default_joints
from twin.joints import JointPosition, JointVelocity
from twin.motion import JointState, MotionLimits, plan_joint_move, plan_stop
from twin.motion.plan import NO_ACCELERATION, NO_VELOCITY

LIMITS = MotionLimits()
HERE = JointPosition(100, 200, 100)


def test_time_and_distance_of_a_stop_by_hand() -> None:
    """From 80 mm/s: V/A + A/J = 0.2 + 0.1 s at a mean of 40 mm/s."""
    stop = plan_stop(LIMITS, JointState(HERE, JointVelocity(80, 0, 0)))
    assert stop.duration_s == pytest.approx(0.3)
    assert stop.end.position == pytest.approx((112, 200, 100))


def test_joints_do_not_wait_for_each_other() -> None:
    stop = plan_stop(LIMITS, JointState(HERE, JointVelocity(80, -10, 0)))
    # rho2 needs 2 sqrt(10 / 4000) = 0.1 s
    assert stop.velocity_at(0.1001).rho2_mm_s == pytest.approx(0, abs=1e-9)
    assert stop.velocity_at(0.1001).rho1_mm_s > 40


def test_a_robot_at_rest_need_not_stop() -> None:
    stop = plan_stop(LIMITS, JointState.at_rest(HERE))
    assert stop.duration_s == 0
    assert stop.end == JointState.at_rest(HERE)


@given(default_joints(), default_joints(), between(0, 1))
def test_a_stop_in_flight_keeps_the_limits_and_ends_at_rest_sooner(
    start: JointPosition, target: JointPosition, when: float
) -> None:
    plan = plan_joint_move(LIMITS, start, target)
    t_s = when * plan.duration_s
    stop = plan_stop(LIMITS, plan.state_at(t_s))
    assert_within(stop, LIMITS)
    assert_sample_agrees(stop)
    assert stop.duration_s <= plan.duration_s - t_s + 1e-6
    assert (stop.end.velocity, stop.end.acceleration) == (NO_VELOCITY, NO_ACCELERATION)
    travelled = np.abs(np.subtract(stop.end.position, stop.start.position))
    assert np.all(travelled <= np.abs(np.subtract(target, stop.start.position)) + 1e-6)
