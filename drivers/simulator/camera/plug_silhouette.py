"""The robot's own plug in the picture: a dark cylinder that hides what is behind it."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from drivers.simulator.camera.textured_plane import Canvas
from drivers.simulator.view import Pose

PLUG_DIAMETER_MM = 65.0
PLUG_LENGTH_MM = 300.0
PLUG_REFLECTANCE = 0.035
_NEAREST_MM = 25.0
_FRACTION_BITS = 6


def draw_plug(
    canvas: Canvas,
    optics: CameraModel,
    T_camera_plug: Pose,
    T_camera_socket: Pose,
    sigma_px: float,
) -> None:
    """Put the visible part of the plug over the canvas, as far as it is not in the socket.

    Args:
        canvas: Reflectance of every pixel, shape (height, width); changed in place.
        optics: The camera.
        T_camera_plug: Pose of the plug's tip, z the insertion axis, shape (4, 4) [mm].
        T_camera_socket: Pose of the socket's face, shape (4, 4) [mm].
        sigma_px: Standard deviation of the plug's blur.
    """
    outline = _outline(optics, T_camera_plug, _inserted_mm(T_camera_plug, T_camera_socket))
    if outline is None:
        return
    margin = int(np.ceil(3.5 * sigma_px)) + 2
    low = np.maximum(np.floor(outline.min(axis=0)).astype(int) - margin, 0)
    size = np.array([optics.width, optics.height])
    high = np.minimum(np.ceil(outline.max(axis=0)).astype(int) + margin + 1, size)
    if np.any(low >= high):
        return
    mask = np.zeros((high[1] - low[1], high[0] - low[0]), dtype=np.uint8)
    polygon = np.round((outline - low) * 2**_FRACTION_BITS).astype(np.int32)
    cv2.fillConvexPoly(mask, polygon, (255,), cv2.LINE_AA, _FRACTION_BITS)
    soft = cv2.GaussianBlur(mask, (0, 0), sigma_px)
    below = canvas[low[1] : high[1], low[0] : high[0]]
    below += np.multiply(soft, np.float32(1 / 255), dtype=np.float32) * (PLUG_REFLECTANCE - below)


def _inserted_mm(T_camera_plug: Pose, T_camera_socket: Pose) -> float:
    """How far the tip is behind the socket's face, measured along the plug."""
    face_normal = T_camera_socket[:3, 2]
    depth = float(face_normal @ (T_camera_plug[:3, 3] - T_camera_socket[:3, 3]))
    along = float(face_normal @ T_camera_plug[:3, 2])
    return max(depth / along, 0.0) if along > 0.1 else 0.0


def _outline(
    optics: CameraModel, T_camera_plug: Pose, inserted_mm: float
) -> NDArray[np.float64] | None:
    """Convex outline of the cylinder in the picture, shape (n, 2) [px]; None behind the camera."""
    angles = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    back = np.linspace(inserted_mm, PLUG_LENGTH_MM, 24)
    rim = PLUG_DIAMETER_MM / 2 * np.column_stack((np.cos(angles), np.sin(angles)))
    points = np.concatenate(
        [np.column_stack((rim, np.full(len(rim), -distance))) for distance in back]
    )
    in_camera = points @ T_camera_plug[:3, :3].T + T_camera_plug[:3, 3]
    in_camera = in_camera[in_camera[:, 2] > _NEAREST_MM]
    in_camera = in_camera[np.all(np.abs(in_camera[:, :2]) < 1.2 * in_camera[:, 2:], axis=1)]
    if len(in_camera) < 3:
        return None
    still = np.zeros(3)
    pixels, _ = cv2.projectPoints(in_camera, still, still, optics.matrix, optics.distortion)
    flat = np.asarray(pixels, dtype=np.float32).reshape(-1, 2)
    return np.asarray(cv2.convexHull(flat), dtype=np.float64).reshape(-1, 2)
