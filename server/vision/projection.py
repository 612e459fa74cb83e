"""Projection through the full camera model, its derivative by the pose, and undistortion.

Pose perturbation used everywhere in this room: delta = (omega, tau), six numbers,

    R' = exp([omega]x) R,    t' = t + tau,

that is a left perturbation: omega [rad] turns the label about its own centre around the axes of
the camera frame, tau [mm] shifts it along the axes of the camera frame.
"""

from __future__ import annotations

from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel

Array = NDArray[np.float64]


class Projection(NamedTuple):
    """Points of the label seen in the picture.

    Attributes:
        pixels: Where they appear, shape (n, 2) [px].
        by_point: Derivative of the pixel by the point in the camera frame, (n, 2, 3) [px/mm].
        by_pose: Derivative of the pixel by (omega, tau), shape (n, 2, 6) [px/rad, px/mm].
    """

    pixels: Array
    by_point: Array
    by_pose: Array


def project(camera: CameraModel, T_camera_label: Array, points_mm: Array) -> Projection:
    """Project label points and differentiate (equations in drivers.camera.CameraModel).

    Args:
        camera: Intrinsics and distortion.
        T_camera_label: Pose, shape (4, 4), translation [mm].
        points_mm: Label coordinates, shape (n, 2) in the label's plane or (n, 3) [mm].
    """
    rotated = points_mm @ T_camera_label[:3, : points_mm.shape[1]].T
    in_camera = rotated + T_camera_label[:3, 3]
    depth = in_camera[:, 2]
    x, y = in_camera[:, 0] / depth, in_camera[:, 1] / depth

    r2 = x * x + y * y
    radial = 1 + r2 * (camera.k1 + r2 * (camera.k2 + r2 * camera.k3))
    slope = 2 * (camera.k1 + r2 * (2 * camera.k2 + r2 * 3 * camera.k3))  # d radial / d r2, times 2
    p1, p2 = camera.p1, camera.p2
    x_d = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)
    y_d = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y
    pixels = np.column_stack((camera.fx * x_d + camera.cx, camera.fy * y_d + camera.cy))

    du_dx = camera.fx * (radial + x * x * slope + 2 * p1 * y + 6 * p2 * x)
    du_dy = camera.fx * (x * y * slope + 2 * p1 * x + 2 * p2 * y)
    dv_dx = camera.fy * (x * y * slope + 2 * p1 * x + 2 * p2 * y)
    dv_dy = camera.fy * (radial + y * y * slope + 6 * p1 * y + 2 * p2 * x)

    by_point = np.empty((len(x), 2, 3))
    for row, (by_x, by_y) in enumerate(((du_dx, du_dy), (dv_dx, dv_dy))):
        by_point[:, row, 0] = by_x / depth
        by_point[:, row, 1] = by_y / depth
        by_point[:, row, 2] = -(by_x * x + by_y * y) / depth

    by_pose = np.empty((len(x), 2, 6))
    # d(exp([omega]x) q)/d omega = -[q]x, so row g of by_point turns into q x g.
    by_pose[:, :, :3] = np.cross(rotated[:, None, :], by_point)
    by_pose[:, :, 3:] = by_point
    return Projection(pixels, by_point, by_pose)


def undistort(camera: CameraModel, pixels: Array) -> Array:
    """Directions (x, y, 1) in the camera frame of pixels; inverse of the projection.

    Args:
        camera: Intrinsics and distortion.
        pixels: Shape (n, 2) [px].

    Returns:
        Normalised x and y, shape (n, 2), exact to far below a thousandth of a pixel.
    """
    criteria = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, 40, 1e-12)
    points = np.ascontiguousarray(pixels, dtype=np.float64).reshape(-1, 1, 2)
    rays = cv2.undistortPoints(points, camera.matrix, camera.distortion, criteria=criteria)
    return np.asarray(rays, dtype=np.float64).reshape(-1, 2)


def perturbed(T_camera_label: Array, delta: Array) -> Array:
    """Apply (omega, tau), shape (6,), to a pose as this module defines it."""
    moved = T_camera_label.copy()
    moved[:3, :3] = rotation_matrix(delta[:3]) @ T_camera_label[:3, :3]
    moved[:3, 3] += delta[3:]
    return moved


def rotation_matrix(vector: Array) -> Array:
    """Rotation of a rotation vector (axis times angle [rad]), shape (3, 3)."""
    return np.asarray(cv2.Rodrigues(np.asarray(vector, dtype=np.float64))[0], dtype=np.float64)


def rotation_vector(matrix: Array) -> Array:
    """Rotation vector (axis times angle [rad]) of a rotation matrix, shape (3,)."""
    return np.asarray(cv2.Rodrigues(matrix)[0], dtype=np.float64).reshape(3)
