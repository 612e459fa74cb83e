"""Where each moving part is, as pure functions of the robot's joints and the car's pose."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from twin.geometry import RobotGeometry
from twin.joints import JointPosition, TipPosition
from twin.kinematics import gamma
from twin.scene.frames import Vector, pose, rotation_x
from twin.scene.state import Pose

LABEL_BESIDE_SOCKET_MM = 120.0
"""Nominal distance of the QR label from the socket, along the rail (the camera's offset)."""


class RobotPose(NamedTuple):
    """Pivots of the parts in the base frame [mm] and the directions of the bars [rad].

    The bars A-B and D-F are parallel. Their angle and that of E-C are turns about z from x.
    """

    a: Vector
    d: Vector
    e: Vector
    v: Vector
    plug: Vector
    left_angle_rad: float
    right_angle_rad: float


def robot_pose(geometry: RobotGeometry, joints: JointPosition) -> RobotPose:
    """Places of all moving parts for given joints.

    Raises:
        LegsCannotCloseError: No platform position belongs to these joints.
    """
    x, y = gamma.platform(geometry, joints)
    half = geometry.platform_width_mm / 2
    a = (geometry.e1x_mm + joints.rho1_mm, geometry.e1y_mm, 0.0)
    e = (geometry.base_width_mm - joints.rho2_mm - geometry.e2x_mm, geometry.e2y_mm, 0.0)
    rise, reach = gamma.tip_offset(geometry, joints.rho3_mm)
    return RobotPose(
        a=a,
        d=(a[0] + half, a[1] + geometry.e_py_mm, 0.0),
        e=e,
        v=(x, y, 0.0),
        plug=(x, y + rise, reach),
        left_angle_rad=math.atan2(y - a[1], x - half - a[0]),
        right_angle_rad=math.atan2(y - e[1], x + half - e[0]),
    )


def region_center(geometry: RobotGeometry) -> TipPosition:
    """Centre of the regular box for the plug tip: V at its centre, rho3 in mid-stroke [mm]."""
    box = geometry.regular_box
    middle = (geometry.rho3.min_mm + geometry.rho3.max_mm) / 2
    rise, reach = gamma.tip_offset(geometry, middle)
    return TipPosition(box.center_x_mm, box.center_y_mm + rise, reach)


def nominal_socket(geometry: RobotGeometry) -> Pose:
    """T_base_socket of a car parked in the middle, its inlet facing the insertion axis.

    The socket's frame has x along the rail, y up along the inlet's face and z into the car.
    """
    return pose(rotation_x(-geometry.theta_rad), region_center(geometry))


def nominal_label(T_base_socket: Pose) -> Pose:
    """T_base_label of a label stuck beside a socket with an upright frame."""
    upside_down = np.diag([-1.0, -1.0, 1.0])
    offset = pose(upside_down, (LABEL_BESIDE_SOCKET_MM, 0.0, 0.0))
    return np.asarray(T_base_socket @ offset)


def upright(T_base_socket: Pose) -> Pose:
    """The same socket with y as far up as its axis allows.

    A car stands on its wheels, so only the socket's place and axis say where the car is; how
    the measurement's x and y axes are turned about that axis does not matter.
    """
    axis = np.asarray(T_base_socket[:3, 2], dtype=float)
    side = np.cross((0.0, 1.0, 0.0), axis)
    length = float(np.linalg.norm(side))
    if length < 1e-6:  # the inlet looks straight up or down: any heading will do
        side, length = np.array([1.0, 0.0, 0.0]), 1.0
    x = side / length
    rotation: NDArray[np.float64] = np.column_stack([x, np.cross(axis, x), axis])
    return pose(rotation, T_base_socket[:3, 3])
