"""The picture's poses against the kinematics."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.twin.strategies import PosedRobot, posed_robots
from twin.geometry import RobotGeometry
from twin.kinematics import gamma
from twin.scene import poses
from twin.scene.frames import pose, rotation_x


@given(posed_robots())
def test_every_bar_connects_its_two_joints(robot: PosedRobot) -> None:
    g = robot.geometry
    at = poses.robot_pose(g, robot.joints)
    x, y = gamma.platform(g, robot.joints)
    half, length = g.platform_width_mm / 2, g.leg_length_mm

    def end(start: tuple[float, float, float], angle_rad: float) -> tuple[float, float]:
        return start[0] + length * math.cos(angle_rad), start[1] + length * math.sin(angle_rad)

    assert end(at.a, at.left_angle_rad) == pytest.approx((x - half, y), abs=1e-6)  # B
    assert end(at.d, at.left_angle_rad) == pytest.approx((x, y + g.e_py_mm), abs=1e-6)  # F
    assert end(at.e, at.right_angle_rad) == pytest.approx((x + half, y), abs=1e-6)  # C


@given(posed_robots())
def test_the_plug_is_where_the_kinematics_say(robot: PosedRobot) -> None:
    at = poses.robot_pose(robot.geometry, robot.joints)
    assert at.plug == pytest.approx(tuple(gamma.forward(robot.geometry, robot.joints)), abs=1e-6)


@given(st.floats(-0.9, 0.9))
def test_a_nominal_socket_faces_the_plug(theta_rad: float) -> None:
    geometry = RobotGeometry(theta_rad=theta_rad)
    socket = poses.nominal_socket(geometry)
    assert socket[:3, 2] == pytest.approx(geometry.insertion_axis)
    assert socket[:3, 3] == pytest.approx(tuple(poses.region_center(geometry)))
    assert np.linalg.det(socket[:3, :3]) == pytest.approx(1)


def test_a_nominal_label_is_seen_upright_beside_the_socket(geometry: RobotGeometry) -> None:
    socket = poses.nominal_socket(geometry)
    label = poses.nominal_label(socket)
    assert label[:3, 3] - socket[:3, 3] == pytest.approx([120, 0, 0])
    assert label[:3, 0] == pytest.approx([-1, 0, 0])  # right, for one who looks at the car
    assert label[1, 1] < -0.9  # its y points down
    assert label[:3, 2] == pytest.approx(socket[:3, 2])


@given(st.floats(-math.pi, math.pi), st.floats(-0.3, 0.3))
def test_how_a_measured_socket_is_rolled_does_not_tilt_the_car(
    roll_rad: float, tilt_rad: float
) -> None:
    c, s = math.cos(roll_rad), math.sin(roll_rad)
    rolled = rotation_x(tilt_rad) @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])
    upright = poses.upright(pose(rolled, (1.0, 2.0, 3.0)))
    assert upright[:3, :3] == pytest.approx(rotation_x(tilt_rad), abs=1e-12)
    assert upright[:3, 3] == pytest.approx([1, 2, 3])


def test_a_socket_that_looks_up_still_has_a_pose() -> None:
    upright = poses.upright(pose(rotation_x(-math.pi / 2), (0.0, 0.0, 0.0)))
    assert upright[:3, :3].T @ upright[:3, :3] == pytest.approx(np.eye(3))
