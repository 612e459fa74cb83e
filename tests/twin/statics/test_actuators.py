from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.twin.strategies import PosedRobot, between, posed_robots
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import LegsCannotCloseError, alpha, forward, jacobian
from twin.kinematics.alpha import LegVectors, PlatformPosition
from twin.statics import TipForce, actuator_forces, alpha_actuator_forces

DEFAULT = RobotGeometry()
FORCES = st.builds(TipForce, between(-100, 100), between(-100, 100), between(-100, 100))


@pytest.mark.parametrize("y_mm", [100.0, 335.0, 500.0])
def test_a_push_away_from_the_rail_asks_f_d_over_2h_of_each_carriage(y_mm: float) -> None:
    rho1_mm, rho2_mm = alpha.inverse(DEFAULT, PlatformPosition(650, y_mm))
    reach_mm = math.sqrt(532**2 - y_mm**2)
    forces = actuator_forces(DEFAULT, JointPosition(rho1_mm, rho2_mm, 100), TipForce(0, 70, 0))
    expected_n = 70 * reach_mm / (2 * y_mm)
    assert forces[:2] == pytest.approx((expected_n, expected_n))


def test_a_push_along_the_rail_is_shared_with_opposite_signs() -> None:
    rho1_mm, rho2_mm = alpha.inverse(DEFAULT, PlatformPosition(650, 335))
    forces = actuator_forces(DEFAULT, JointPosition(rho1_mm, rho2_mm, 100), TipForce(10, 0, 0))
    assert forces == pytest.approx((5, -5, 0))


def test_a_push_along_the_insertion_axis_is_the_force_of_the_slide() -> None:
    rho1_mm, rho2_mm = alpha.inverse(DEFAULT, PlatformPosition(650, 335))
    push = TipForce(*(70 * part for part in DEFAULT.insertion_axis))
    forces = actuator_forces(DEFAULT, JointPosition(rho1_mm, rho2_mm, 100), push)
    assert forces.rho3_n == pytest.approx(70)
    # the platform holds the sideways part: 70 sin(-10 deg) d / 2h
    assert forces.rho1_n == pytest.approx(-70 * math.sin(math.radians(10)) * 413.2784 / 670)


@given(posed_robots(), FORCES)
def test_virtual_work(robot: PosedRobot, force: TipForce) -> None:
    """The work of the actuators over a small motion is the work of the tip's force."""
    forces = actuator_forces(robot.geometry, robot.joints, force)
    step = 1e-4
    for joint, direction in enumerate(step * np.eye(3)):
        ahead = forward(robot.geometry, JointPosition(*np.add(robot.joints, direction)))
        behind = forward(robot.geometry, JointPosition(*np.subtract(robot.joints, direction)))
        work = np.dot(force, np.subtract(ahead, behind))
        assert forces[joint] * 2 * step == pytest.approx(work, abs=1e-7)


@given(posed_robots(), FORCES)
def test_forces_are_the_transpose_of_the_jacobian(robot: PosedRobot, force: TipForce) -> None:
    expected = jacobian(robot.geometry, robot.joints).T @ force
    assert actuator_forces(robot.geometry, robot.joints, force) == pytest.approx(expected, abs=1e-9)


def test_folded_flat_no_force_holds_the_platform() -> None:
    with pytest.raises(LegsCannotCloseError, match="folded flat"):
        alpha_actuator_forces(LegVectors(532, 0, 532, 0), 0, 1)
