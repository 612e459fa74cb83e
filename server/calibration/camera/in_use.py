"""What the camera numbers that are in use miss on pictures of the board."""

from __future__ import annotations

import math
from collections.abc import Sequence

import cv2
import numpy as np

from drivers.camera import CameraModel
from server.calibration.camera.board_views import BoardView


def camera_error_px(camera: CameraModel, views: Sequence[BoardView]) -> float:
    """Root mean square distance of all corners from where the camera has them [px].

    Each board is placed where that suits its corners best.

    Args:
        camera: Not made from these pictures.
        views: One or more.
    """
    squares, corners = 0.0, 0
    for view in views:
        plane = np.column_stack((view.board_mm, np.zeros(len(view.board_mm))))
        _, turned, place = cv2.solvePnP(plane, view.image_px, camera.matrix, camera.distortion)
        seen, _ = cv2.projectPoints(plane, turned, place, camera.matrix, camera.distortion)
        squares += float(np.sum((seen.reshape(-1, 2) - view.image_px) ** 2))
        corners += len(view.image_px)
    return math.sqrt(squares / corners)
