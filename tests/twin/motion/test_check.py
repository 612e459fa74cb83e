from __future__ import annotations

import time

import pytest

from twin.geometry import JointRange, RobotGeometry
from twin.joints import JointPosition, JointVelocity, TipPosition
from twin.kinematics import (
    LegsCannotCloseError,
    NearSingularityError,
    SingularityLimits,
    UnreachableError,
    inverse,
)
from twin.motion import (
    JointState,
    MotionLimits,
    UnsafePlanError,
    check_plan,
    plan_joint_move,
    plan_straight_line,
)

DEFAULT = RobotGeometry()
LIMITS = MotionLimits()
HERE = JointPosition(180, 180, 100)


def test_a_move_within_the_workspace_is_safe() -> None:
    check_plan(DEFAULT, plan_joint_move(LIMITS, HERE, JointPosition(300, 100, 150)))
    check_plan(
        DEFAULT,
        plan_straight_line(
            DEFAULT,
            LIMITS,
            inverse(DEFAULT, TipPosition(560, 240, 220)),
            TipPosition(740, 390, 270),
        ),
    )


def test_a_plan_that_takes_no_time_is_still_looked_at() -> None:
    check_plan(DEFAULT, plan_joint_move(LIMITS, HERE, HERE))
    outside = HERE._replace(rho3_mm=160)
    with pytest.raises(UnsafePlanError):
        check_plan(DEFAULT, plan_joint_move(LIMITS, outside, outside))


def test_leaving_a_joint_limit_tells_when_and_where() -> None:
    plan = plan_joint_move(LIMITS, HERE, HERE._replace(rho3_mm=170))
    with pytest.raises(UnsafePlanError) as caught:
        check_plan(DEFAULT, plan)
    error = caught.value
    assert isinstance(error.cause, UnreachableError)
    assert error.cause.joint == "rho3"
    assert plan.position_at(error.time_s) == pytest.approx(error.joints)
    assert plan.position_at(error.time_s - 0.01).rho3_mm <= 150 < error.joints.rho3_mm
    assert str(error).startswith(f"{error.time_s:.2f} s into the motion, at rho1 = 180.0 mm, ")
    assert "above its upper limit of 150 mm" in str(error)
    assert error.context["joint"] == "rho3"


def test_an_overshoot_between_two_safe_ends_is_found() -> None:
    """At 14 mm/s towards a limit 0.5 mm away, turning back: the stop alone needs 1.4 mm."""
    start = JointState(HERE._replace(rho3_mm=149.5), JointVelocity(0, 0, 14))
    plan = plan_joint_move(LIMITS, start, HERE._replace(rho3_mm=149.5))
    with pytest.raises(UnsafePlanError, match="rho3 would have to be"):
        check_plan(DEFAULT, plan)


def test_a_way_near_a_singularity_is_refused_though_its_ends_are_safe() -> None:
    """Both carriages run outwards, so that the platform sinks by 12 mm or more before it turns."""
    low = JointPosition(70, 70, 100)
    check_plan(DEFAULT, plan_joint_move(LIMITS, low, low))
    plan = plan_joint_move(LIMITS, JointState(low, JointVelocity(-80, -80, 0)), low)
    with pytest.raises(UnsafePlanError, match="the two legs are nearly in line") as caught:
        check_plan(DEFAULT, plan)
    assert isinstance(caught.value.cause, NearSingularityError)
    assert 0 < caught.value.time_s < 0.3


def test_joints_that_belong_to_no_pose_are_refused() -> None:
    geometry = RobotGeometry(rho1=JointRange(min_mm=-200, max_mm=420))
    plan = plan_joint_move(LIMITS, JointPosition(100, 100, 100), JointPosition(-100, 0, 100))
    with pytest.raises(UnsafePlanError) as caught:
        check_plan(geometry, plan, singularity_limits=SingularityLimits(parallel=0))
    assert isinstance(caught.value.cause, LegsCannotCloseError)


def test_ten_seconds_of_motion_are_checked_in_milliseconds() -> None:
    slow = LIMITS.scaled(0.7)
    plan = plan_joint_move(slow, HERE._replace(rho3_mm=50), JointPosition(300, 100, 148))
    assert plan.duration_s > 9.9
    durations = []
    for _ in range(15):
        began = time.perf_counter()
        check_plan(DEFAULT, plan)
        durations.append(time.perf_counter() - began)
    # 1.5 ms on an idle laptop core; the fastest of many is robust against a busy machine
    assert min(durations) < 0.01
