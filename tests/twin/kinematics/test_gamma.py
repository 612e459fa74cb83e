from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given

from tests.twin.strategies import PosedRobot, between, posed_robots
from twin.geometry import JointRange, RobotGeometry
from twin.joints import JointPosition, TipPosition
from twin.kinematics import (
    UnreachableError,
    UnreachableReason,
    alpha,
    check_joint_limits,
    forward,
    forward_many,
    inverse,
    inverse_many,
    inverse_unlimited,
    jacobian,
    platform,
    within_limits_many,
)
from twin.kinematics.alpha import PlatformPosition
from twin.kinematics.gamma import platform_for_tip

DEFAULT = RobotGeometry()


def test_tip_of_the_default_robot_by_hand() -> None:
    """Slide at 100 mm, 10 deg down: y falls by 17.365 and z is 150 + 98.481."""
    rho1_mm, rho2_mm = alpha.inverse(DEFAULT, PlatformPosition(650, 335))
    tip = forward(DEFAULT, JointPosition(rho1_mm, rho2_mm, 100))
    assert tip == pytest.approx((650, 317.6352, 248.4808), abs=1e-4)


def test_offsets_of_the_slide_by_hand() -> None:
    """Y = y + e3y - e4y + 0.6 rho3 and Z = e3z - e4z + 0.8 rho3."""
    geometry = RobotGeometry(
        theta_rad=math.atan2(3, 4), e3y_mm=1, e3z_mm=20, e4y_mm=300 - 290, e4z_mm=5
    )
    joints = JointPosition(*alpha.inverse(geometry, PlatformPosition(650, 335)), 100)
    assert forward(geometry, joints) == pytest.approx((650, 335 + 1 - 10 + 60, 20 - 5 + 80))
    v, rho3_mm = platform_for_tip(geometry, TipPosition(650, 386, 95))
    assert (*v, rho3_mm) == pytest.approx((650, 335, 100))


@given(posed_robots())
def test_forward_undoes_inverse(robot: PosedRobot) -> None:
    assert forward(robot.geometry, robot.joints) == pytest.approx(robot.tip, abs=1e-8)


@given(posed_robots())
def test_inverse_undoes_forward(robot: PosedRobot) -> None:
    again = inverse_unlimited(robot.geometry, forward(robot.geometry, robot.joints))
    assert again == pytest.approx(robot.joints, abs=1e-8)


@given(posed_robots())
def test_jacobian_is_the_slope_of_forward(robot: PosedRobot) -> None:
    step = 1e-4
    slopes = [
        np.subtract(
            forward(robot.geometry, JointPosition(*np.add(robot.joints, direction))),
            forward(robot.geometry, JointPosition(*np.subtract(robot.joints, direction))),
        )
        / (2 * step)
        for direction in step * np.eye(3)
    ]
    np.testing.assert_allclose(
        jacobian(robot.geometry, robot.joints), np.column_stack(slopes), atol=2e-6
    )


@given(posed_robots(), between(-50, 50))
def test_the_slide_alone_moves_the_tip_along_the_insertion_axis(
    robot: PosedRobot, travel_mm: float
) -> None:
    moved = robot.joints._replace(rho3_mm=robot.joints.rho3_mm + travel_mm)
    step = np.subtract(forward(robot.geometry, moved), forward(robot.geometry, robot.joints))
    np.testing.assert_allclose(step, travel_mm * np.array(robot.geometry.insertion_axis), atol=1e-9)
    assert platform(robot.geometry, moved) == platform(robot.geometry, robot.joints)


def tip_for(rho1_mm: float, rho2_mm: float, rho3_mm: float) -> TipPosition:
    return forward(DEFAULT, JointPosition(rho1_mm, rho2_mm, rho3_mm))


def test_below_a_limit() -> None:
    with pytest.raises(UnreachableError) as caught:
        inverse(DEFAULT, tip_for(-12.3, 300, 100))
    assert str(caught.value) == (
        "rho1 would have to be -12.3 mm, 12.3 mm below its lower limit of 0 mm"
    )
    assert caught.value.reason is UnreachableReason.BELOW_JOINT_LIMIT
    assert (caught.value.joint, caught.value.limit_mm) == ("rho1", 0.0)
    assert caught.value.excess_mm == pytest.approx(12.3)
    assert caught.value.context["reason"] == "below_joint_limit"


def test_above_a_limit() -> None:
    with pytest.raises(UnreachableError) as caught:
        inverse(DEFAULT, tip_for(100, 200, 153.5))
    assert str(caught.value) == (
        "rho3 would have to be 153.5 mm, 3.5 mm above its upper limit of 150 mm"
    )
    assert caught.value.reason is UnreachableReason.ABOVE_JOINT_LIMIT


def test_two_limits_are_both_named_and_the_worse_one_counts() -> None:
    with pytest.raises(UnreachableError) as caught:
        inverse(DEFAULT, tip_for(-5, 440, 100))
    assert "rho1 would have to be -5.0 mm" in str(caught.value)
    assert "rho2 would have to be 440.0 mm, 20.0 mm above" in str(caught.value)
    assert (caught.value.joint, caught.value.limit_mm) == ("rho2", 420.0)


def test_legs_too_short() -> None:
    with pytest.raises(UnreachableError, match="mm too short"):
        inverse(DEFAULT, TipPosition(650, 540, 250))


@pytest.mark.parametrize("axis", range(3))
def test_not_a_position(axis: int) -> None:
    tip = [650.0, 300.0, 250.0]
    tip[axis] = math.nan
    with pytest.raises(UnreachableError, match="is not a position"):
        inverse(DEFAULT, TipPosition(*tip))


def test_joints_on_their_limits_are_reachable() -> None:
    assert inverse(DEFAULT, tip_for(0, 420, 150)) == pytest.approx((0, 420, 150))


def test_joints_that_are_not_numbers_are_outside_their_limits() -> None:
    with pytest.raises(UnreachableError, match="rho2 would have to be nan"):
        check_joint_limits(DEFAULT, JointPosition(100, math.nan, 100))


@given(posed_robots())
def test_many_poses_agree_with_one(robot: PosedRobot) -> None:
    geometry = robot.geometry
    tips = np.array([robot.tip, [0.0, 5000.0, 0.0]])
    joints = inverse_many(geometry, tips)
    assert joints[0] == pytest.approx(robot.joints, abs=1e-9)
    assert np.isnan(joints[1]).all()
    back = forward_many(geometry, joints)
    assert back[0] == pytest.approx(robot.tip, abs=1e-8)
    assert np.isnan(back[1]).all()


def test_within_limits_of_many() -> None:
    geometry = RobotGeometry(rho3=JointRange(min_mm=60, max_mm=150))
    joints = np.array(
        [
            [0, 420, 60],
            [-0.1, 420, 60],
            [0, 420.1, 60],
            [0, 420, 50],
            [math.nan, 420, 60],
            [-1e-7, 420, 60],
        ]
    )
    assert within_limits_many(geometry, joints).tolist() == [True, False, False, False, False, True]
