"""Pictures of the board, taken once for all tests here."""

from __future__ import annotations

import math

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.labels.board_sheet import BoardLayout
from tests.support.board_pictures import board_picture

Picture = tuple[str, NDArray[np.uint8]]

LAYOUT = BoardLayout()
TRUTH = CameraModel(
    width=640, height=480, fx=530.0, fy=532.0, cx=324.3, cy=235.2,
    k1=-0.05, k2=0.03, p1=4e-4, p2=-3e-4,
)  # fmt: skip


def pose(rng: np.random.Generator, number: int) -> NDArray[np.float64]:
    """The board in turn in each of nine parts of the picture, tilted and turned."""
    turn = (number % 2) * math.pi / 2
    tilt = rng.uniform(-0.6, 0.6, 2)
    rotation = np.asarray(cv2.Rodrigues(np.array([0.0, 0.0, turn]))[0])
    rotation = np.asarray(cv2.Rodrigues(np.array([*tilt, 0.0]))[0]) @ rotation
    middle = np.array([LAYOUT.columns, LAYOUT.rows, 0.0]) * LAYOUT.square_mm / 2
    z_mm = rng.uniform(260, 450)
    column, row = number % 3 - 1, number // 3 % 3 - 1
    place = np.array([0.36 * column * z_mm, 0.27 * row * z_mm, z_mm])
    transform = np.eye(4)
    transform[:3, :3] = rotation
    transform[:3, 3] = place - rotation @ middle
    return transform


@pytest.fixture(scope="session")
def pictures() -> list[Picture]:
    """Twenty good pictures."""
    rng = np.random.default_rng(5)
    return [
        (f"{number:02d}.png", board_picture(TRUTH, LAYOUT, pose(rng, number), number))
        for number in range(20)
    ]
