from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given

from tests.twin.strategies import PosedRobot, posed_robots
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import NearSingularityError, SingularityLimits, alpha, singularity
from twin.kinematics.alpha import LegVectors, PlatformPosition

DEFAULT = RobotGeometry()
LENGTH = DEFAULT.leg_length_mm
ALLOWED = SingularityLimits()


def legs_at(left_rad: float, right_rad: float) -> LegVectors:
    return LegVectors(
        LENGTH * math.cos(left_rad),
        LENGTH * math.sin(left_rad),
        LENGTH * math.cos(right_rad),
        LENGTH * math.sin(right_rad),
    )


def joints_at_height(y_mm: float, x_mm: float = 650.0) -> JointPosition:
    return JointPosition(*alpha.inverse(DEFAULT, PlatformPosition(x_mm, y_mm)), 100.0)


def test_folded_flat_is_parallel_singular() -> None:
    assert singularity.measures_of_legs(DEFAULT, legs_at(0, 0)).parallel == 0


def test_aligned_legs_are_parallel_singular_though_not_flat() -> None:
    assert singularity.measures_of_legs(DEFAULT, legs_at(0.3, -0.3)).parallel == pytest.approx(0)


def test_perpendicular_legs_are_parallel_regular() -> None:
    found = singularity.measures_of_legs(DEFAULT, legs_at(math.pi / 4, math.pi / 4))
    assert found.parallel == pytest.approx(1)


def test_a_leg_perpendicular_to_the_rail_is_serial_singular() -> None:
    found = singularity.measures_of_legs(DEFAULT, legs_at(math.pi / 2, 0.5))
    assert found.serial_left == pytest.approx(0, abs=1e-15)
    assert found.serial_right == pytest.approx(math.cos(0.5))


def test_parallelogram_is_flat_when_the_leg_is_parallel_to_its_bar() -> None:
    """B-F = (80, 80): the leg at 45 deg lies along it."""
    geometry = RobotGeometry(e_py_mm=80)
    found = singularity.measures_of_legs(geometry, legs_at(math.pi / 4, math.pi / 4))
    assert found.parallelogram_area_mm2 == pytest.approx(0, abs=1e-9)
    assert found.parallelogram == pytest.approx(0, abs=1e-12)


def test_parallelogram_area_by_hand() -> None:
    """Folded flat, the bar hangs 80 mm below the leg: 532 x 80; at 45 deg it is square to it."""
    assert singularity.measures_of_legs(
        DEFAULT, legs_at(0, 0)
    ).parallelogram_area_mm2 == pytest.approx(532 * 80)
    upright = singularity.measures_of_legs(DEFAULT, legs_at(math.pi / 4, math.pi / 4))
    assert upright.parallelogram_area_mm2 == pytest.approx(532 * math.hypot(80, 80))
    assert upright.parallelogram == pytest.approx(1)


@pytest.mark.parametrize("angle", np.linspace(0, math.pi / 2, 10))
def test_a_bar_below_the_platform_never_lets_the_parallelogram_fold(angle: float) -> None:
    assert singularity.measures_of_legs(DEFAULT, legs_at(angle, angle)).parallelogram > 0.7


@given(posed_robots())
def test_parallel_measure_is_the_determinant_of_the_velocity_equation(robot: PosedRobot) -> None:
    matrix_a, _ = alpha.velocity_matrices(robot.legs)
    found = singularity.measures(robot.geometry, robot.joints)
    assert found.parallel == pytest.approx(
        np.linalg.det(matrix_a) / robot.geometry.leg_length_mm**2, abs=1e-9
    )


@given(posed_robots())
def test_many_poses_agree_with_one(robot: PosedRobot) -> None:
    joints = np.array([robot.joints, [math.nan] * 3])
    many = singularity.measures_many(robot.geometry, joints)
    one = singularity.measures(robot.geometry, robot.joints)
    assert many[0] == pytest.approx(
        [getattr(one, name) for name in singularity.MEASURE_NAMES], abs=1e-9
    )
    assert np.isnan(many[1]).all()


def test_the_regular_square_is_far_from_all_singularities() -> None:
    for y_mm in (235, 335, 435):
        for x_mm in (550, 650, 750):
            found = singularity.check(DEFAULT, joints_at_height(y_mm, x_mm), ALLOWED)
            assert min(found.parallel, found.serial_left, found.serial_right) > 0.5


def test_nearly_folded_flat_is_refused() -> None:
    with pytest.raises(NearSingularityError, match="the two legs are nearly in line") as caught:
        singularity.check(DEFAULT, joints_at_height(40), ALLOWED)
    assert caught.value.measure == "parallel"
    assert caught.value.value == pytest.approx(2 * 40 / 532, abs=0.001)
    assert caught.value.minimum == 0.2


def test_nearly_perpendicular_is_refused() -> None:
    limits = SingularityLimits(parallel=0)
    with pytest.raises(NearSingularityError, match="the left leg stands nearly perpendicular"):
        singularity.check(DEFAULT, joints_at_height(530), limits)


def test_a_flat_parallelogram_is_refused() -> None:
    geometry = RobotGeometry(e_py_mm=80)
    y_mm = 532 * math.sqrt(0.5)
    joints = JointPosition(*alpha.inverse(geometry, PlatformPosition(650, y_mm)), 100.0)
    with pytest.raises(NearSingularityError, match="parallelogram of the left leg is nearly flat"):
        singularity.check(geometry, joints, ALLOWED)
