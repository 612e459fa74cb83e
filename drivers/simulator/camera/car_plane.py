"""The sheet metal around the socket: where it is, how it is curved, how paint looks."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.simulator.camera.coarse_grid import CoarseGrid, Field
from drivers.simulator.camera.row_motion import RowMotion
from drivers.simulator.view import Pose

PAINT_REFLECTANCE = 0.24
CLEAR_COAT = 0.16
"""Share of the surroundings that the coat mirrors, with the reflectances of a garage."""

_CURVE_MM = 1700.0  # radius, from sill to roof
_CREASE_MM = -112.0
_SEAM_MM = -172.0
_MOTTLE_CELLS, _MOTTLE_MM = 512, 1.2


def dot(a: NDArray[np.float32], b: NDArray[np.float32]) -> Field:
    """Dot products along the last axis."""
    return np.asarray(np.einsum("...i,...i->...", a, b), dtype=np.float32)


@dataclass(frozen=True, slots=True, eq=False)
class CarPlane:
    """The plane of the socket's face, at the nodes of a grid.

    Attributes:
        places_mm: In the socket's frame, z = 0, shape (m, n, 3).
        in_camera: The same in the camera frame, shape (m, n, 3).
        sight: Unit lines of sight in the socket's frame, shape (m, n, 3).
        normal: Of the plane, in the camera frame, into the car, shape (3,).
    """

    places_mm: NDArray[np.float32]
    in_camera: NDArray[np.float32]
    sight: NDArray[np.float32]
    normal: NDArray[np.float64]

    def mirrored(self, slope_x: Field | float, slope_y: Field | float) -> NDArray[np.float32]:
        """Directions into which a surface of these slopes mirrors the lines of sight."""
        normal = np.empty_like(self.sight)
        normal[..., 0], normal[..., 1], normal[..., 2] = slope_x, slope_y, -1.0
        normal /= np.sqrt(dot(normal, normal))[..., None]
        facing = dot(self.sight, normal)[..., None]
        return np.asarray(self.sight - 2 * facing * normal, dtype=np.float32)


def car_plane(grid: CoarseGrid, T_camera_socket: Pose, rows: RowMotion) -> CarPlane:
    """The plane as the rows of one picture see it."""
    toward = np.linalg.inv(T_camera_socket[:3, (0, 1, 3)])
    on_plane = cv2.perspectiveTransform(grid.rays.astype(np.float32), toward)
    x, y = (np.asarray(part, dtype=np.float32) for part in cv2.split(on_plane))
    if not rows.still:
        rows.correct(x, y, grid.v_px, T_camera_socket)
    places = np.stack((x, y, np.zeros_like(x)), axis=-1)
    turn = T_camera_socket[:3, :3].astype(np.float32)
    in_camera = places @ turn.T + T_camera_socket[:3, 3].astype(np.float32)
    sight = np.asarray(in_camera @ turn, dtype=np.float32)
    sight /= np.sqrt(dot(sight, sight))[..., None]
    return CarPlane(places, in_camera, sight, T_camera_socket[:3, 2])


class CarPaint:
    """Grey paint under a clear coat on a curved panel with a crease and a seam."""

    def __init__(self) -> None:
        noise = np.random.default_rng(1804).standard_normal(
            (_MOTTLE_CELLS, _MOTTLE_CELLS), dtype=np.float32
        )
        fine = cv2.GaussianBlur(noise, (0, 0), 1.5, borderType=cv2.BORDER_REFLECT)
        broad = cv2.GaussianBlur(noise, (0, 0), 14, borderType=cv2.BORDER_REFLECT)
        self._mottle = np.asarray(fine / fine.std() + broad / broad.std(), dtype=np.float32)

    def slopes(self, car: CarPlane) -> tuple[Field, Field]:
        """Slopes of the panel's outer normal along x and y: a barrel, kinked at the crease."""
        x, y = car.places_mm[..., 0], car.places_mm[..., 1]
        kink = np.tanh((y - 0.06 * x - _CREASE_MM) / 9)
        slope_y = y / _CURVE_MM + np.float32(0.10) * kink
        return x / np.float32(4 * _CURVE_MM), np.asarray(slope_y, dtype=np.float32)

    def diffuse(self, car: CarPlane) -> Field:
        """Reflectance of the paint without lamps: flakes, dust, mirrored ceiling and floor."""
        x, y = car.places_mm[..., 0], car.places_mm[..., 1]
        slope_x, slope_y = self.slopes(car)
        mirrored = car.mirrored(slope_x, slope_y)
        upward = -mirrored[..., 1]
        # Bright ceiling, a wall in shade, a dark floor; the edges between them are soft.
        around = 0.35 + 0.30 * _step((upward - 0.16) / 0.05) - 0.18 * _step((-upward - 0.1) / 0.06)
        around += 0.45 * np.exp(-(((mirrored[..., 0] + 0.30 - 0.25 * upward) / 0.07) ** 2))
        paint = PAINT_REFLECTANCE * (1 - 0.9 * slope_y)
        cells = np.float32(1 / _MOTTLE_MM)
        mottle = cv2.remap(
            self._mottle, x * cells, y * cells, cv2.INTER_LINEAR, borderMode=cv2.BORDER_WRAP
        )
        paint *= 1 + 0.008 * mottle
        shade = paint + CLEAR_COAT * around
        seam = np.exp(-(((x + 0.04 * y - _SEAM_MM) / 2.4) ** 2))
        return np.asarray(np.clip(shade * (1 - 0.88 * seam), 0.02, 0.95), dtype=np.float32)


def _step(value: Field) -> Field:
    return np.asarray(0.5 + 0.5 * np.tanh(value), dtype=np.float32)
