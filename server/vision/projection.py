"""Projection through the full camera model, its derivative by the pose, and undistortion.

Pose perturbation used everywhere in this room: delta = (omega, tau), six numbers,

    R' = exp([omega]x) R,    t' = t + tau,

that is a left perturbation: omega [rad] turns the label about its own centre around the axes of
the camera frame, tau [mm] shifts it along the axes of the camera frame.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel

Array = NDArray[np.float64]

_NEWTON_STEPS = 8


@dataclass(frozen=True, slots=True, eq=False)
class Projection:
    """Points of the label seen in the picture.

    Attributes:
        pixels: Where they appear, shape (n, 2) [px].
        by_point: Derivative of the pixel by the point in the camera frame, (n, 2, 3) [px/mm].
        lever: Points turned into the camera frame, before the shift, shape (n, 3) [mm].
    """

    pixels: Array
    by_point: Array
    lever: Array

    @property
    def by_pose(self) -> Array:
        """Derivative of the pixel by (omega, tau), shape (n, 2, 6) [px/rad, px/mm]."""
        both = [_by_pose(self.lever, self.by_point[:, row]) for row in (0, 1)]
        return np.stack(both, axis=1)

    def by_pose_along(self, direction: Array) -> Array:
        """Derivative by (omega, tau) of the pixel's place along a direction, shape (n, 6).

        Args:
            direction: Unit vectors in the picture, shape (n, 2).
        """
        gradient = direction[:, :1] * self.by_point[:, 0] + direction[:, 1:] * self.by_point[:, 1]
        return _by_pose(self.lever, gradient)


def _by_pose(lever: Array, gradient: Array) -> Array:
    """Derivative by (omega, tau) of something whose derivative by the point is known, (n, 6).

    d(exp([omega]x) q)/d omega = -[q]x, so the gradient g turns into q x g.
    """
    x, y, z = lever.T
    a, b, c = gradient.T
    derivative = np.empty((6, len(lever)))  # long rows are quicker than long columns
    derivative[0] = y * c - z * b
    derivative[1] = z * a - x * c
    derivative[2] = x * b - y * a
    derivative[3:] = gradient.T
    return derivative.T


def project(camera: CameraModel, T_camera_label: Array, points_mm: Array) -> Projection:
    """Project label points and differentiate (equations in drivers.camera.CameraModel).

    Args:
        camera: Intrinsics and distortion.
        T_camera_label: Pose, shape (4, 4), translation [mm].
        points_mm: Label coordinates, shape (n, 2) in the label's plane or (n, 3) [mm].
    """
    lever = points_mm @ T_camera_label[:3, : points_mm.shape[1]].T
    in_camera = lever + T_camera_label[:3, 3]
    nearness = 1 / in_camera[:, 2]
    x, y = in_camera[:, 0] * nearness, in_camera[:, 1] * nearness

    seen = _distorted(camera, x, y)
    pixels = np.empty((len(x), 2))
    pixels[:, 0] = camera.fx * seen.x + camera.cx
    pixels[:, 1] = camera.fy * seen.y + camera.cy
    rows = (
        (camera.fx * seen.x_by_x, camera.fx * seen.mixed),
        (camera.fy * seen.mixed, camera.fy * seen.y_by_y),
    )
    by_point = np.empty((len(x), 2, 3))
    for row, (by_x, by_y) in enumerate(rows):
        by_point[:, row, 0] = by_x * nearness
        by_point[:, row, 1] = by_y * nearness
        by_point[:, row, 2] = -(by_x * x + by_y * y) * nearness
    return Projection(pixels, by_point, lever)


class _Distorted(NamedTuple):
    """Distorted coordinates and their derivatives; those across are equal: mixed."""

    x: Array
    y: Array
    x_by_x: Array
    mixed: Array
    y_by_y: Array


def _distorted(camera: CameraModel, x: Array, y: Array) -> _Distorted:
    r2 = x * x + y * y
    radial = 1 + r2 * (camera.k1 + r2 * (camera.k2 + r2 * camera.k3))
    slope = 2 * (camera.k1 + r2 * (2 * camera.k2 + r2 * 3 * camera.k3))  # d radial / d r2, times 2
    p1, p2 = camera.p1, camera.p2
    xy = x * y
    return _Distorted(
        x=x * radial + 2 * p1 * xy + p2 * (r2 + 2 * x * x),
        y=y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * xy,
        x_by_x=radial + x * x * slope + 2 * p1 * y + 6 * p2 * x,
        mixed=xy * slope + 2 * (p1 * x + p2 * y),
        y_by_y=radial + y * y * slope + 6 * p1 * y + 2 * p2 * x,
    )


def undistort(camera: CameraModel, pixels: Array) -> Array:
    """Directions (x, y, 1) in the camera frame of pixels; inverse of the projection.

    Args:
        camera: Intrinsics and distortion.
        pixels: Shape (n, 2) [px].

    Returns:
        Normalised x and y, shape (n, 2), exact to far below a thousandth of a pixel.
    """
    # Newton's method. OpenCV's own takes its stopping rule in one way in version 4 and in
    # another in version 5, and its default is not exact for strong distortion.
    wanted = (pixels - (camera.cx, camera.cy)) / (camera.fx, camera.fy)
    x, y = wanted[:, 0].copy(), wanted[:, 1].copy()
    for _ in range(_NEWTON_STEPS):
        seen = _distorted(camera, x, y)
        off_x, off_y = seen.x - wanted[:, 0], seen.y - wanted[:, 1]
        determinant = seen.x_by_x * seen.y_by_y - seen.mixed**2
        x -= (seen.y_by_y * off_x - seen.mixed * off_y) / determinant
        y -= (seen.x_by_x * off_y - seen.mixed * off_x) / determinant
    return np.column_stack((x, y))


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
