"""Pictures of the board, taken once for all tests here."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.labels.board_layout import BoardLayout
from server.simulated_board import board_pictures

Picture = tuple[str, NDArray[np.uint8]]

LAYOUT = BoardLayout()
TRUTH = CameraModel(
    width=640, height=480, fx=530.0, fy=532.0, cx=324.3, cy=235.2,
    k1=-0.05, k2=0.03, p1=4e-4, p2=-3e-4,
)  # fmt: skip


@pytest.fixture(scope="session")
def pictures() -> list[Picture]:
    """Twenty good pictures."""
    return list(board_pictures(TRUTH, LAYOUT, 20, np.random.default_rng(5)))
