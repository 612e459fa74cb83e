"""The robot's own plug in the picture: a dark cylinder with a sheen, which hides what is behind."""

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
_SHEEN_REFLECTANCE = 0.12
_SHEEN_FROM_TO = (-2.75, -2.15)  # around the cylinder, from its x towards its y: up on the left
_SHEEN_BLUR_MM = 5.0
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
    inserted_mm = _inserted_mm(T_camera_plug, T_camera_socket)
    visible_mm = (inserted_mm, PLUG_LENGTH_MM)
    outline = _outline(optics, T_camera_plug, visible_mm, (0.0, 2 * np.pi))
    if outline is None:
        return
    margin = int(np.ceil(3.5 * sigma_px)) + 2
    low = np.maximum(np.floor(outline.min(axis=0)).astype(int) - margin, 0)
    size = np.array([optics.width, optics.height])
    high = np.minimum(np.ceil(outline.max(axis=0)).astype(int) + margin + 1, size)
    if np.any(low >= high):
        return
    shape = (int(high[1] - low[1]), int(high[0] - low[0]))
    shade = np.full(shape, PLUG_REFLECTANCE, dtype=np.float32)
    sheen = _outline(optics, T_camera_plug, visible_mm, _SHEEN_FROM_TO)
    if sheen is not None:
        px_per_mm = optics.fx / max(float(T_camera_plug[2, 3]), _NEAREST_MM)
        soft = _soft_mask(sheen - low, shape, max(_SHEEN_BLUR_MM * px_per_mm, sigma_px))
        shade += soft * np.float32(_SHEEN_REFLECTANCE - PLUG_REFLECTANCE)
    below = canvas[low[1] : high[1], low[0] : high[0]]
    below += _soft_mask(outline - low, shape, sigma_px) * (shade - below)


def _soft_mask(polygon: NDArray[np.float64], shape: tuple[int, int], sigma_px: float) -> Canvas:
    """1 in a polygon [px], 0 outside, with a soft edge.

    A wide blur is worked out on a coarser mask, whose pixels it hides.
    """
    factor = int(np.clip(sigma_px / 4, 1, 16))
    small = (-(-shape[0] // factor), -(-shape[1] // factor))
    corners = (polygon + 0.5) / factor - 0.5
    mask = np.zeros(small, dtype=np.uint8)
    fixed = np.round(corners * 2**_FRACTION_BITS).astype(np.int32)
    cv2.fillConvexPoly(mask, fixed, (255,), cv2.LINE_AA, _FRACTION_BITS)
    soft = np.asarray(cv2.GaussianBlur(mask, (0, 0), sigma_px / factor), dtype=np.float32)
    soft *= np.float32(1 / 255)
    if factor > 1:
        large = cv2.resize(soft, (small[1] * factor, small[0] * factor))
        soft = np.asarray(large[: shape[0], : shape[1]], dtype=np.float32)
    return soft


def _inserted_mm(T_camera_plug: Pose, T_camera_socket: Pose) -> float:
    """How far the tip is behind the socket's face, measured along the plug."""
    face_normal = T_camera_socket[:3, 2]
    depth = float(face_normal @ (T_camera_plug[:3, 3] - T_camera_socket[:3, 3]))
    along = float(face_normal @ T_camera_plug[:3, 2])
    return max(depth / along, 0.0) if along > 0.1 else 0.0


def _outline(
    optics: CameraModel,
    T_camera_plug: Pose,
    along_mm: tuple[float, float],
    around: tuple[float, float],
) -> NDArray[np.float64] | None:
    """Convex outline of a part of the cylinder, shape (n, 2) [px]; None behind the camera.

    Args:
        optics: The camera.
        T_camera_plug: Pose of the tip.
        along_mm: From here to there, from the tip backwards.
        around: From this angle to that one.
    """
    angles = np.linspace(*around, 48)
    rim = PLUG_DIAMETER_MM / 2 * np.column_stack((np.cos(angles), np.sin(angles)))
    points = np.concatenate(
        [np.column_stack((rim, np.full(len(rim), -back))) for back in np.linspace(*along_mm, 24)]
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
