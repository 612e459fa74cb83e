"""The board in one picture: where it is, how it is held, and how well it is seen."""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.calibration.camera.board_views import FEWEST_CORNERS, FEWEST_MARKERS, BoardView
from server.calibration.camera.sharpness import Sharpness, sharpness_of
from server.labels.board_layout import BoardLayout

Image = NDArray[np.uint8]

STRANGE_SHARE = 0.12
"""Corners that miss the flat board by more than this share of a square belong to another one."""


@dataclass(frozen=True, slots=True, eq=False)
class Held:
    """How the board is held, as far as the camera is known before.

    Attributes:
        middle: Of its corners, as shares of the picture from its middle, -1 to 1, shape (2,).
        left_away_rad: Its left edge is tipped away from the camera.
        top_away_rad: The same of its upper edge.
        turn_rad: In the plane of the picture, clockwise.
        distance: To the middle of the board, in diagonals of the board.
    """

    middle: NDArray[np.float64]
    left_away_rad: float
    top_away_rad: float
    turn_rad: float
    distance: float


@dataclass(frozen=True, slots=True, eq=False)
class BoardSight:
    """What one picture shows.

    Attributes:
        markers: How many were read.
        view: The corners; None: fewer than twelve.
        strange: The markers are not arranged as on the board that is looked for.
        held: None: without a view.
        sharpness: Of its edges; None: without a view, or not to be told.
    """

    markers: int
    view: BoardView | None = None
    strange: bool = False
    held: Held | None = None
    sharpness: Sharpness | None = None

    @property
    def outline_px(self) -> list[tuple[float, float]]:
        """Around all corners, in order."""
        if self.view is None:
            return []
        hull = cv2.convexHull(self.view.image_px.astype(np.float32)).reshape(-1, 2)
        return [(round(x, 1), round(y, 1)) for x, y in hull.tolist()]


class BoardFinder:
    """Finds one board in pictures of one camera.

    Args:
        layout: The board.
        optics: The camera as far as it is known; only what to do next rests on that.
    """

    def __init__(self, layout: BoardLayout, optics: CameraModel) -> None:
        self.layout = layout
        self._optics = optics
        self._detector = cv2.aruco.CharucoDetector(layout.board)
        self._corners_mm = np.asarray(layout.board.getChessboardCorners(), np.float64)[:, :2]

    def find(self, image: Image, name: str) -> BoardSight:
        """Look for the board.

        Args:
            image: Grey values, shape (height, width).
            name: Of the picture.
        """
        corners, numbers, _, marker_numbers = self._detector.detectBoard(image)
        markers = 0 if marker_numbers is None else len(marker_numbers)
        if numbers is None or len(numbers) < FEWEST_CORNERS:
            found = 0 if numbers is None else len(numbers)
            nothing = markers >= FEWEST_MARKERS and found == 0
            hardly = markers >= 2 * FEWEST_MARKERS and 3 * found < markers
            return BoardSight(markers, strange=nothing or hardly)
        view = BoardView(
            name,
            self._corners_mm[np.ravel(numbers)],
            np.asarray(corners, dtype=np.float64).reshape(-1, 2),
        )
        missed_mm = _flatness_mm(view)
        if missed_mm > STRANGE_SHARE * self.layout.square_mm:
            return BoardSight(markers, strange=True)
        sharpness = sharpness_of(image, view, self.layout.square_mm)
        return BoardSight(markers, view, held=self._held(view), sharpness=sharpness)

    def _held(self, view: BoardView) -> Held:
        optics, layout = self._optics, self.layout
        plane = np.column_stack((view.board_mm, np.zeros(len(view.board_mm))))
        _, turned, place = cv2.solvePnP(plane, view.image_px, optics.matrix, optics.distortion)
        rotation = np.asarray(cv2.Rodrigues(turned)[0])
        size_mm = np.array([layout.columns, layout.rows, 0.0]) * layout.square_mm
        middle_mm = rotation @ (0.5 * size_mm) + np.ravel(place)
        normal = rotation[:, 2] if rotation[2, 2] > 0 else -rotation[:, 2]
        whole_px = np.array([optics.width, optics.height])
        return Held(
            2 * view.image_px.mean(axis=0) / whole_px - 1,
            math.atan2(normal[0], normal[2]),
            math.atan2(normal[1], normal[2]),
            math.atan2(rotation[1, 0], rotation[0, 0]),
            float(np.linalg.norm(middle_mm) / np.linalg.norm(size_mm)),
        )


def _flatness_mm(view: BoardView) -> float:
    """How far the corners are from where a plane would have them: the median, on the board.

    The lens bends lines by less than a board of another layout does.
    """
    found, _ = cv2.findHomography(view.image_px, view.board_mm, cv2.RANSAC, 3.0)
    if np.size(found) != 9:  # corners that make up no plane at all
        return math.inf
    there = cv2.perspectiveTransform(view.image_px.reshape(-1, 1, 2), found).reshape(-1, 2)
    return float(np.median(np.linalg.norm(there - view.board_mm, axis=1)))
