"""Pictures of the calibration board, as somebody takes them by hand with a camera of known numbers.

The board is drawn by the same lens model that the calibration solves for, so this tells what noise,
blur and the choice of places do to a calibration; not whether a real lens bends light otherwise.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.labels.board_layout import BoardLayout

TEXTURE_PX_PER_MM = 3
BORDER_MM = 20
GREY_WALL = 120
NOISE = 2.0
BLUR_PX = 0.8
PARTS = 3
"""The board is held in turn into each of 3 x 3 parts of the picture."""
TILT_RAD = 0.6
NEAR_MM, FAR_MM = 260.0, 450.0
_HALF_VIEW = (0.36, 0.27)
"""Of the middle of an outer part, over the distance, for a view of 62 by 49 degrees."""


def board_pictures(
    camera: CameraModel, layout: BoardLayout, count: int, rng: np.random.Generator
) -> Iterator[tuple[str, NDArray[np.uint8]]]:
    """Names and pictures: near and far, tilted, every other one turned by 90 degrees."""
    for number in range(count):
        T_camera_board = held_board(layout, number, rng)
        yield f"{number:02d}.png", board_picture(camera, layout, T_camera_board, rng)


def held_board(layout: BoardLayout, number: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """T_camera_board of one picture, shape (4, 4) [mm]; the parts of the picture take turns."""
    turn = np.asarray(cv2.Rodrigues(np.array([0.0, 0.0, (number % 2) * math.pi / 2]))[0])
    tilt = np.asarray(cv2.Rodrigues(np.array([*rng.uniform(-TILT_RAD, TILT_RAD, 2), 0.0]))[0])
    rotation = tilt @ turn
    middle = np.array([layout.columns, layout.rows, 0.0]) * layout.square_mm / 2
    z_mm = rng.uniform(NEAR_MM, FAR_MM)
    column, row = number % PARTS - 1, number // PARTS % PARTS - 1
    place = z_mm * np.array([_HALF_VIEW[0] * column, _HALF_VIEW[1] * row, 1.0])
    transform = np.eye(4)
    transform[:3, :3] = rotation
    transform[:3, 3] = place - rotation @ middle
    return transform


def board_picture(
    camera: CameraModel,
    layout: BoardLayout,
    T_camera_board: NDArray[np.float64],
    rng: np.random.Generator,
) -> NDArray[np.uint8]:
    """The board (origin its upper left corner, x right, y down) with blur and noise."""
    # where each ray meets the plane of the board, in the board's coordinates
    inverse = np.linalg.inv(T_camera_board).astype(np.float32)
    origin, directions = inverse[:3, 3], _rays(camera) @ inverse[:3, :3].T
    depth = -origin[2] / directions[..., 2]
    on_board = origin[:2] + depth[..., None] * directions[..., :2]
    places = (on_board + BORDER_MM) * TEXTURE_PX_PER_MM - 0.5
    sharp = cv2.remap(
        _texture(layout), places[..., 0], places[..., 1], cv2.INTER_CUBIC,
        borderMode=cv2.BORDER_CONSTANT, borderValue=GREY_WALL,
    )  # fmt: skip
    picture = cv2.GaussianBlur(sharp.astype(np.float32), (0, 0), BLUR_PX)
    noise = NOISE * rng.standard_normal(picture.shape, dtype=np.float32)
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


@lru_cache(maxsize=1)
def _rays(camera: CameraModel) -> NDArray[np.float32]:
    """Direction of every pixel in the camera frame, shape (height, width, 3), z = 1."""
    v, u = np.mgrid[0 : camera.height, 0 : camera.width].astype(np.float64)
    pixels = np.stack((u, v), axis=-1).reshape(-1, 1, 2)
    points = cv2.undistortPoints(pixels, camera.matrix, camera.distortion)
    flat = np.asarray(points, dtype=np.float32).reshape(camera.height, camera.width, 2)
    return np.concatenate((flat, np.ones((*flat.shape[:2], 1), dtype=np.float32)), axis=-1)
