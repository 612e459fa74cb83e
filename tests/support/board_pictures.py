"""Pictures of the calibration board through a camera whose numbers are known."""

from __future__ import annotations

from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.labels.board_sheet import BoardLayout

TEXTURE_PX_PER_MM = 3
BORDER_MM = 20
GREY_WALL = 120


def board_picture(
    camera: CameraModel, layout: BoardLayout, T_camera_board: NDArray[np.float64], seed: int
) -> NDArray[np.uint8]:
    """The board (origin its upper left corner, x right, y down) with blur and noise."""
    texture = _texture(layout)
    rays = _rays(camera)
    # where each ray meets the plane of the board, in the board's coordinates
    inverse = np.linalg.inv(T_camera_board)
    origin, directions = inverse[:3, 3], rays @ inverse[:3, :3].T
    depth = -origin[2] / directions[..., 2]
    on_board = origin[:2] + depth[..., None] * directions[..., :2]
    places = ((on_board + BORDER_MM) * TEXTURE_PX_PER_MM - 0.5).astype(np.float32)
    sharp = cv2.remap(
        texture, places[..., 0], places[..., 1], cv2.INTER_CUBIC,
        borderMode=cv2.BORDER_CONSTANT, borderValue=GREY_WALL,
    )  # fmt: skip
    picture = cv2.GaussianBlur(sharp.astype(np.float64), (0, 0), 0.8)
    noise = np.random.default_rng(seed).normal(0.0, 2.0, picture.shape)
    return np.asarray(np.clip(0.85 * picture + 12 + noise, 0, 255), dtype=np.uint8)


@lru_cache(maxsize=4)
def _texture(layout: BoardLayout) -> NDArray[np.uint8]:
    size = (
        round(layout.columns * layout.square_mm * TEXTURE_PX_PER_MM),
        round(layout.rows * layout.square_mm * TEXTURE_PX_PER_MM),
    )
    image = layout.board.generateImage(size, marginSize=0)
    border = BORDER_MM * TEXTURE_PX_PER_MM
    padded = cv2.copyMakeBorder(
        image, border, border, border, border, cv2.BORDER_CONSTANT, value=255
    )
    return np.asarray(padded, dtype=np.uint8)


@lru_cache(maxsize=4)
def _rays(camera: CameraModel) -> NDArray[np.float64]:
    """Direction of every pixel in the camera frame, shape (height, width, 3), z = 1."""
    v, u = np.mgrid[0 : camera.height, 0 : camera.width].astype(np.float64)
    pixels = np.stack((u, v), axis=-1).reshape(-1, 1, 2)
    points = cv2.undistortPoints(pixels, camera.matrix, camera.distortion)
    flat = np.asarray(points).reshape(camera.height, camera.width, 2)
    return np.concatenate((flat, np.ones((*flat.shape[:2], 1))), axis=-1)
