"""From the project's millimetres and matrices to the scene's metres and quaternions.

The scene's world frame is the base frame O-xyz: x along the rail, y up, z towards the car. Only
its unit differs, because a browser's depth buffer and lights are made for metres.
"""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from twin.scene.state import Pose

Vector: TypeAlias = tuple[float, float, float]
Quaternion: TypeAlias = tuple[float, float, float, float]

METRES_PER_MM = 1e-3
UPRIGHT: Quaternion = (1.0, 0.0, 0.0, 0.0)


def metres(point_mm: Vector | NDArray[np.float64]) -> Vector:
    """A point or vector in the scene's unit."""
    x, y, z = point_mm
    return (float(x) * METRES_PER_MM, float(y) * METRES_PER_MM, float(z) * METRES_PER_MM)


def turn(axis: Vector, angle_rad: float) -> Quaternion:
    """Unit quaternion (w, x, y, z) of a rotation about a unit axis."""
    half = angle_rad / 2
    s = math.sin(half)
    return (math.cos(half), axis[0] * s, axis[1] * s, axis[2] * s)


def quaternion(rotation: NDArray[np.float64]) -> Quaternion:
    """Unit quaternion (w, x, y, z) of a rotation matrix, shape (3, 3).

    Shepperd's method: the largest of the four components is found first, so that no division
    is by a small number.
    """
    r = rotation
    trace = float(np.trace(r))
    squares = [trace, float(r[0, 0]), float(r[1, 1]), float(r[2, 2])]
    largest = int(np.argmax(squares))
    if largest == 0:
        q = [1 + trace, r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]]
    else:
        i = largest - 1
        j, k = (i + 1) % 3, (i + 2) % 3
        q = [0.0] * 4
        q[0] = r[k, j] - r[j, k]
        q[1 + i] = 1 + r[i, i] - r[j, j] - r[k, k]
        q[1 + j] = r[j, i] + r[i, j]
        q[1 + k] = r[k, i] + r[i, k]
    w, x, y, z = np.asarray(q, dtype=float) / np.linalg.norm(q)
    return (float(w), float(x), float(y), float(z))


def pose(rotation: NDArray[np.float64], position_mm: ArrayLike) -> Pose:
    """Homogeneous transform, shape (4, 4), of a rotation (3, 3) and a position [mm]."""
    transform = np.eye(4)
    transform[:3, :3] = rotation
    transform[:3, 3] = position_mm
    return transform


def rotation_x(angle_rad: float) -> NDArray[np.float64]:
    """Rotation about x, shape (3, 3)."""
    c, s = math.cos(angle_rad), math.sin(angle_rad)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
