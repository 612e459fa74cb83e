from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.twin.strategies import PosedRobot, posed_robots
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import LegsCannotCloseError, alpha, forward, platform
from twin.kinematics.alpha import PlatformPosition
from twin.statics import LoadCase, Loads, actuator_loads, actuator_loads_many
from twin.statics.loads import GRAVITY_M_S2

DEFAULT = RobotGeometry()
LOADS = Loads()
CASES = st.sampled_from(LoadCase)


def potential_energy_n_mm(geometry: RobotGeometry, joints: JointPosition, loads: Loads) -> float:
    """Height of every mass times its weight, from the drawing and not from the formula."""
    v = platform(geometry, joints)
    tip = forward(geometry, joints)
    feet_y = {"AB": geometry.e1y_mm, "DF": geometry.e1y_mm, "CE": geometry.e2y_mm}
    # the bar DF hangs e_py beside AB at both ends, which adds a constant only
    bars = sum(loads.bar_mass_kg * (foot + v.y_mm) / 2 for foot in feet_y.values())
    slide = (loads.slide_mass_kg + loads.cable_share * loads.cable_mass_kg) * tip.y_mm
    return GRAVITY_M_S2 * (loads.platform_mass_kg * v.y_mm + slide + bars)


@given(posed_robots(), CASES)
def test_the_actuators_work_equals_the_gain_in_height_and_the_work_at_the_plug(
    robot: PosedRobot, case: LoadCase
) -> None:
    loads = Loads(insertion_force_n=70, withdrawal_force_n=55)
    forces = actuator_loads(robot.geometry, robot.joints, loads, case)
    axial_n = {LoadCase.HOLDING: 0, LoadCase.INSERTING: 70, LoadCase.WITHDRAWING: -55}[case]
    push = axial_n * np.array(robot.geometry.insertion_axis)
    step = 1e-3
    for joint, direction in enumerate(step * np.eye(3)):
        ahead = JointPosition(*np.add(robot.joints, direction))
        behind = JointPosition(*np.subtract(robot.joints, direction))
        gain = potential_energy_n_mm(robot.geometry, ahead, loads) - potential_energy_n_mm(
            robot.geometry, behind, loads
        )
        moved = np.subtract(forward(robot.geometry, ahead), forward(robot.geometry, behind))
        assert forces[joint] * 2 * step == pytest.approx(gain + push @ moved, abs=2e-5)


@given(posed_robots(), CASES)
def test_many_poses_agree_with_one(robot: PosedRobot, case: LoadCase) -> None:
    many = actuator_loads_many(robot.geometry, np.array([robot.joints]), LOADS, case)
    assert many[0] == pytest.approx(actuator_loads(robot.geometry, robot.joints, LOADS, case))


def test_the_default_robot_in_the_lowest_row_of_its_square() -> None:
    pose = JointPosition(*alpha.inverse(DEFAULT, PlatformPosition(650, 235)), 100)
    holding = actuator_loads(DEFAULT, pose, LOADS, LoadCase.HOLDING)
    # (2 + 1 + 0.7 + 0.45) kg on V; d = 477.28 mm, h = 235 mm
    expected_n = 4.15 * GRAVITY_M_S2 * math.sqrt(532**2 - 235**2) / (2 * 235)
    assert holding[:2] == pytest.approx((expected_n, expected_n))
    inserting = actuator_loads(DEFAULT, pose, LOADS, LoadCase.INSERTING)
    withdrawing = actuator_loads(DEFAULT, pose, LOADS, LoadCase.WITHDRAWING)
    # the plug goes in downwards: the socket pushes the platform up and takes weight off the legs
    assert inserting.rho1_n < holding.rho1_n < withdrawing.rho1_n
    weight_n = 1.7 * GRAVITY_M_S2 * math.sin(math.radians(10))
    assert inserting.rho3_n == pytest.approx(70 - weight_n)
    assert withdrawing.rho3_n == pytest.approx(-70 - weight_n)


def test_where_no_pose_is_there_are_no_forces() -> None:
    poses = np.array([[0.0, 0.0, 100.0], [100.0, 100.0, 100.0]])
    forces = actuator_loads_many(DEFAULT, poses, LOADS, LoadCase.HOLDING)
    assert np.isnan(forces[0]).all()
    assert np.isfinite(forces[1]).all()
    with pytest.raises(LegsCannotCloseError):
        actuator_loads(DEFAULT, JointPosition(0, 0, 100), LOADS, LoadCase.HOLDING)
