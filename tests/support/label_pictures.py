"""Pictures of labels with known poses, rendered without any part of the locator or the simulator.

A label is sampled twice as finely as the pixels, through the full camera model, in linear light;
lens blur and motion come before the pixels are formed, light, noise, tone curve, sharpening and
compression after.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from tests.support.label_prints import Print
from tests.support.picture_taking import Shot, expose, motion_kernel

Array = NDArray[np.float64]
Canvas = NDArray[np.float32]
Image = NDArray[np.uint8]

FINENESS = 2
_MOST_TEXELS = 24


@dataclass(frozen=True, slots=True, eq=False)
class Placed:
    """A label in front of the camera.

    Attributes:
        label: What is printed.
        T_camera_label: Where it is, shape (4, 4) [mm].
        lift_mm: How far its top left corner of the paper has come loose, towards the camera.
        crease: From where on along the diagonal: 0 is the middle, 2 the corner of the paper.
        bow_mm: How far its left and right borders stand off, towards the camera; its middle does
            not.
        luminous: Light of its own on top of what it reflects, as a telephone's screen has.
    """

    label: Print
    T_camera_label: Array
    lift_mm: float = 0.0
    crease: float = 0.4
    bow_mm: float = 0.0
    luminous: float = 0.0


def photograph(
    camera: CameraModel,
    placed: Sequence[Placed],
    shot: Shot,
    rng: np.random.Generator,
) -> Image:
    """Take a picture; later labels lie over earlier ones.

    Args:
        camera: True optics.
        placed: What is in front of it, besides a painted car body.
        shot: Light, blur and sensor.
        rng: Draws the background and the noise.

    Returns:
        Grey values, shape (height, width).
    """
    canvas = _background(camera.width, camera.height, int(rng.integers(6))).copy()
    for item in placed:
        _draw(canvas, camera, item, shot)
    return expose(canvas, shot, rng)


@lru_cache(maxsize=4)
def _rays(camera: CameraModel) -> NDArray[np.float32]:
    """Directions of all pixel centres, shape (height, width, 2)."""
    u, v = np.meshgrid(np.arange(camera.width, dtype=float), np.arange(camera.height, dtype=float))
    pixels = np.stack((u, v), axis=-1).reshape(-1, 1, 2)
    rays = cv2.undistortPoints(pixels, camera.matrix, camera.distortion)
    return np.asarray(rays, dtype=np.float32).reshape(camera.height, camera.width, 2)


@lru_cache(maxsize=24)
def _background(width: int, height: int, number: int) -> Canvas:
    """A painted panel with soft reflections and some things with straight edges."""
    rng = np.random.default_rng((width, number))
    small = rng.uniform(0.15, 0.55, (5, 8)).astype(np.float32)
    canvas = np.asarray(cv2.resize(small, (width, height), interpolation=cv2.INTER_CUBIC))
    for _ in range(14):
        corners = rng.uniform(0, 1, (1, 2)) + rng.uniform(-0.12, 0.12, (4, 2))
        polygon = (corners * (width, height)).round().astype(np.int32)
        cv2.fillConvexPoly(canvas, cv2.convexHull(polygon), float(rng.uniform(0.05, 0.8)))
    background = np.asarray(cv2.GaussianBlur(canvas, (0, 0), 1.2), dtype=np.float32)
    background.flags.writeable = False
    return background


def _draw(canvas: Canvas, camera: CameraModel, item: Placed, shot: Shot) -> None:
    """Put a label over the canvas, blurred as lens and motion do."""
    margin = int(np.ceil(3 * shot.blur_px + np.abs(shot.motion_px).max())) + 2
    box = _box(camera, item, margin)
    if box is None:
        return
    left, top, right, bottom = box
    rays = _rays(camera)[top:bottom, left:right]
    size = ((right - left) * FINENESS, (bottom - top) * FINENESS)
    # Twice the pixels, their centres a quarter of a pixel beside the old ones; exact inside.
    fine = np.asarray(cv2.resize(rays, size, interpolation=cv2.INTER_LINEAR), dtype=np.float32)
    x, y = _hits(fine, item)
    module_px = camera.fx / float(item.T_camera_label[2, 3]) * item.label.module_mm
    texels = int(np.clip(np.ceil(module_px * FINENESS * 0.8), 3, _MOST_TEXELS))
    texture = item.label.with_texels(texels)
    scale = np.float32(texels / item.label.module_mm)
    middle = np.float32((len(texture) - 1) / 2)
    column, row = x * scale + middle, y * scale + middle
    seen = cv2.remap(texture, column, row, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    if item.luminous:
        seen = seen + np.float32(item.luminous)
    outside = np.maximum(np.abs(column - middle), np.abs(row - middle)) - (middle + 0.5)
    alpha = np.clip(0.5 - outside, 0, 1)
    layers = []
    for layer in (seen * alpha, alpha):
        smooth = cv2.GaussianBlur(layer, (0, 0), shot.blur_px * FINENESS)
        kernel = motion_kernel(np.array(shot.motion_px) * FINENESS)
        if kernel is not None:
            smooth = cv2.filter2D(smooth, -1, kernel, borderType=cv2.BORDER_REPLICATE)
        layers.append(
            cv2.resize(smooth, (right - left, bottom - top), interpolation=cv2.INTER_AREA)
        )
    below = canvas[top:bottom, left:right]
    canvas[top:bottom, left:right] = below * (1 - layers[1]) + layers[0]


def _hits(rays: NDArray[np.float32], item: Placed) -> tuple[Canvas, Canvas]:
    """Label coordinates x, y [mm] where rays meet the paper, bent where the paper is."""
    pose = item.T_camera_label
    to_plane = np.linalg.inv(pose[:3, (0, 1, 3)])
    flat = np.asarray(cv2.perspectiveTransform(rays, to_plane), dtype=np.float32)
    x, y = flat[..., 0], flat[..., 1]
    if not (item.lift_mm or item.bow_mm):
        return x, y
    # Direction of each ray in the label frame, per millimetre of depth.
    ways = cv2.transform(rays, pose[:3, :2].T)
    depth = cv2.transform(rays, pose[:3, 2:3].T)
    slope_x, slope_y = ways[..., 0] / depth, ways[..., 1] / depth
    half = item.label.side_mm / 2
    bent_x, bent_y = x, y
    for _ in range(3):
        # The paper bends like a clamped strip beyond the diagonal: quadratically.
        loose = np.clip((-(bent_x + bent_y) / half - item.crease) / (2 - item.crease), 0, 1)
        height = np.float32(item.lift_mm) * loose * loose
        height += np.float32(item.bow_mm) * (bent_x / half) ** 2
        bent_x, bent_y = x - height * slope_x, y - height * slope_y
    return np.asarray(bent_x, dtype=np.float32), np.asarray(bent_y, dtype=np.float32)


def _box(camera: CameraModel, item: Placed, margin: int) -> tuple[int, int, int, int] | None:
    """Pixels that the paper may cover: left, top, right, bottom; None if it is not in view."""
    steps = np.linspace(-0.5, 0.5, 5) * item.label.side_mm
    x, y = np.meshgrid(steps, steps)
    points = np.column_stack((x.ravel(), y.ravel(), np.zeros(x.size)))
    in_camera = points @ item.T_camera_label[:3, :3].T + item.T_camera_label[:3, 3]
    if in_camera[:, 2].min() < 10.0:
        return None
    still = np.zeros(3)
    pixels, _ = cv2.projectPoints(in_camera, still, still, camera.matrix, camera.distortion)
    u, v = np.asarray(pixels).reshape(-1, 2).T
    slack = margin + 2 + (0.1 * (u.max() - u.min()) if item.lift_mm or item.bow_mm else 0)
    left, right = max(int(u.min() - slack), 0), min(int(u.max() + slack) + 1, camera.width)
    top, bottom = max(int(v.min() - slack), 0), min(int(v.max() + slack) + 1, camera.height)
    return (left, top, right, bottom) if left < right and top < bottom else None
