from __future__ import annotations

import numpy as np
import pytest

from twin.geometry import RobotGeometry
from twin.joints import JointPosition, JointVelocity, TipPosition
from twin.kinematics import LegsCannotCloseError, alpha, forward, inverse
from twin.kinematics.alpha import PlatformPosition
from twin.motion import JointState, MotionLimits, plan_joint_move, plan_straight_line
from twin.statics import ActuatorLimits, LoadCase, Loads, actuator_loads, forces_along

DEFAULT = RobotGeometry()
LIMITS = MotionLimits()


def pose(x_mm: float, y_mm: float, rho3_mm: float = 50.0) -> JointPosition:
    return JointPosition(*alpha.inverse(DEFAULT, PlatformPosition(x_mm, y_mm)), rho3_mm)


def test_the_carriages_carry_most_at_the_lowest_point_of_the_way() -> None:
    plan = plan_joint_move(LIMITS, pose(620, 235), pose(680, 435))
    found = forces_along(DEFAULT, plan)
    assert found.rho1.time_s == 0
    assert found.rho1.joints == pytest.approx(pose(620, 235))
    expected = actuator_loads(DEFAULT, pose(620, 235), Loads(), LoadCase.HOLDING)
    assert found.rho1.force_n == pytest.approx(expected.rho1_n)
    assert found.rho1.margin_n == pytest.approx(100 - expected.rho1_n)
    assert found.within_limits
    assert found.worst.joint in {"rho1", "rho2"}


def test_the_lowest_point_is_found_in_the_middle_of_a_way() -> None:
    """The carriages still run outwards when they are called back: the platform dips."""
    moving = JointState(pose(650, 300), JointVelocity(-60, -60, 0))
    plan = plan_joint_move(LIMITS, moving, pose(650, 400))
    found = forces_along(DEFAULT, plan, period_s=1e-3)
    turn_s = 60 / 400 + 0.5 * 400 / 4000  # braking at 400 mm/s2 after a ramp of 4000 mm/s3
    assert 0.1 < found.rho1.time_s <= turn_s + 0.05
    assert found.rho1.time_s < plan.duration_s / 2
    assert plan.velocity_at(found.rho1.time_s).rho1_mm_s == pytest.approx(0, abs=0.5)


def test_the_insertion_asks_the_slide_for_most() -> None:
    start = pose(650, 335, 60)
    tip = forward(DEFAULT, start)
    target = TipPosition(*np.add(tip, 60 * np.array(DEFAULT.insertion_axis)))
    plan = plan_straight_line(DEFAULT, LIMITS, start, target)
    inserting = forces_along(DEFAULT, plan, LoadCase.INSERTING)
    assert inserting.rho3.force_n == pytest.approx(70 - 1.7 * 9.80665 * np.sin(np.radians(10)))
    weak = ActuatorLimits(rho3_n=60)
    overloaded = forces_along(DEFAULT, plan, LoadCase.WITHDRAWING, limits=weak)
    assert not overloaded.within_limits
    assert overloaded.worst.joint == "rho3"
    assert overloaded.worst.force_n < -70
    assert overloaded.worst.margin_n == pytest.approx(60 - abs(overloaded.rho3.force_n))
    assert overloaded.worst.utilisation > 1


def test_a_plan_through_poses_that_do_not_exist_is_refused() -> None:
    away = inverse(DEFAULT, TipPosition(650, 335, 240))
    plan = plan_joint_move(LIMITS, away, JointPosition(0, 0, 100))
    with pytest.raises(LegsCannotCloseError, match="leaves the poses of the robot"):
        forces_along(DEFAULT, plan)
