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
    """Points of the label seen in the picture; arrays run along the points, which is quicker.

    Attributes:
        u_v: Where they appear, shape (2, n) [px].
        by_place: Derivative of the pixel by the point in the camera frame, (2, 3, n) [px/mm].
        lever: Points turned into the camera frame, before the shift, shape (3, n) [mm].
    """

    u_v: Array
    by_place: Array
    lever: Array

    @property
    def pixels(self) -> Array:
        """Where they appear, shape (n, 2) [px]."""
        return self.u_v.T

    @property
    def by_pose(self) -> Array:
        """Derivative of the pixel by (omega, tau), shape (n, 2, 6) [px/rad, px/mm]."""
        both = [_by_pose(self.lever, gradient) for gradient in self.by_place]
        return np.stack(both).transpose(2, 0, 1)

    def along(self, directions: Array) -> Array:
        """Derivative of the pixel along directions in the camera frame, (3, n) -> (2, n)."""
        return np.asarray((self.by_place * directions).sum(axis=1))

    def by_pose_along(self, direction: Array) -> Array:
        """Derivative by (omega, tau) of the pixel's place along a direction, shape (6, n).

        Args:
            direction: Unit vectors in the picture, shape (2, n).
        """
        return _by_pose(self.lever, (self.by_place * direction[:, None]).sum(axis=0))


def _by_pose(lever: Array, gradient: Array) -> Array:
    """Derivative by (omega, tau) of something whose derivative by the point is known, (6, n).

    d(exp([omega]x) q)/d omega = -[q]x, so the gradient g turns into q x g.
    """
    x, y, z = lever
    a, b, c = gradient
    derivative = np.empty((6, lever.shape[1]))
    derivative[0] = y * c - z * b
    derivative[1] = z * a - x * c
    derivative[2] = x * b - y * a
    derivative[3:] = gradient
    return derivative


def project(camera: CameraModel, T_camera_label: Array, points_mm: Array) -> Projection:
    """Project label points and differentiate (equations in drivers.camera.CameraModel).

    Args:
        camera: Intrinsics and distortion.
        T_camera_label: Pose, shape (4, 4), translation [mm].
        points_mm: Label coordinates, shape (n, 2) in the label's plane or (n, 3) [mm].
    """
    lever = T_camera_label[:3, : points_mm.shape[1]] @ points_mm.T
    in_camera = lever + T_camera_label[:3, 3:]
    nearness = 1 / in_camera[2]
    x, y = in_camera[0] * nearness, in_camera[1] * nearness

    seen = _distorted(camera, x, y)
    u_v = np.empty((2, len(x)))
    u_v[0] = camera.fx * seen.x + camera.cx
    u_v[1] = camera.fy * seen.y + camera.cy
    rows = ((camera.fx, seen.x_by_x, seen.mixed), (camera.fy, seen.mixed, seen.y_by_y))
    by_place = np.empty((2, 3, len(x)))
    for gradient, (focal_px, by_x, by_y) in zip(by_place, rows, strict=True):
        scale = focal_px * nearness
        gradient[0] = by_x * scale
        gradient[1] = by_y * scale
        gradient[2] = -(gradient[0] * x + gradient[1] * y)
    return Projection(u_v, by_place, lever)


class _Distorted(NamedTuple):
    """Distorted coordinates and their derivatives; those across are equal: mixed."""

    x: Array
    y: Array
    x_by_x: Array
    mixed: Array
    y_by_y: Array


def _distorted(camera: CameraModel, x: Array, y: Array) -> _Distorted:
    """Brown's model: x' = x radial + 2 p1 x y + p2 (r^2 + 2 x^2), and y' with x, p1 for y, p2."""
    xx, yy, xy = x * x, y * y, x * y
    r2 = xx + yy
    radial = 1 + r2 * (camera.k1 + r2 * (camera.k2 + r2 * camera.k3))
    slope = 2 * camera.k1 + r2 * (4 * camera.k2 + r2 * (6 * camera.k3))  # 2 d radial / d r^2
    p1, p2 = camera.p1, camera.p2
    by_y, by_x = 2 * p1 * y, 2 * p2 * x
    scale = radial + by_y + by_x
    return _Distorted(
        x=x * scale + p2 * r2,
        y=y * scale + p1 * r2,
        x_by_x=scale + xx * slope + 2 * by_x,
        mixed=xy * slope + 2 * p1 * x + 2 * p2 * y,
        y_by_y=scale + yy * slope + 2 * by_y,
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
