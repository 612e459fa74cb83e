"""Rigid poses of the simulated scene: homogeneous transforms, shape (4, 4), translations in mm."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from drivers.simulator.view import Pose
from twin.geometry import RobotGeometry

Vector = NDArray[np.float64]


def pose(rotation: NDArray[np.float64], translation_mm: Vector) -> Pose:
    """Assemble a transform from a rotation, shape (3, 3), and a translation, shape (3,)."""
    result = np.eye(4)
    result[:3, :3] = rotation
    result[:3, 3] = translation_mm
    return result


def inverse(transform: Pose) -> Pose:
    """The inverse of a rigid transform."""
    rotation = transform[:3, :3].T
    return pose(rotation, -rotation @ transform[:3, 3])


def rotation_x(angle_rad: float) -> NDArray[np.float64]:
    """Rotation about x, shape (3, 3)."""
    c, s = math.cos(angle_rad), math.sin(angle_rad)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


def rotation_y(angle_rad: float) -> NDArray[np.float64]:
    """Rotation about y, shape (3, 3)."""
    c, s = math.cos(angle_rad), math.sin(angle_rad)
    return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])


def rotation_z(angle_rad: float) -> NDArray[np.float64]:
    """Rotation about z, shape (3, 3)."""
    c, s = math.cos(angle_rad), math.sin(angle_rad)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def facing_the_car(geometry: RobotGeometry) -> NDArray[np.float64]:
    """Axes of the plug, and of a socket and a label parked straight, in the base frame.

    z along the insertion axis, x against the base's x (right, as seen by one who looks at the
    car), y = z cross x (down). Shape (3, 3), columns x, y, z.
    """
    z = np.array(geometry.insertion_axis)
    x = np.array([-1.0, 0.0, 0.0])
    return np.column_stack((x, np.cross(z, x), z))
