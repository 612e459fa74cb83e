"""The ChArUco board by which a camera is calibrated."""

from __future__ import annotations

from dataclasses import dataclass

import cv2

DICTIONARY = cv2.aruco.DICT_5X5_250


@dataclass(frozen=True, slots=True)
class BoardLayout:
    """A chessboard whose white squares carry markers.

    Attributes:
        columns: Squares side by side.
        rows: Squares one above the other.
        square_mm: Side of a square.
        marker_mm: Side of a marker.
    """

    columns: int = 7
    rows: int = 9
    square_mm: float = 24.0
    marker_mm: float = 17.5

    @property
    def board(self) -> cv2.aruco.CharucoBoard:
        """The board as OpenCV detects it; its first row is the upper one."""
        return cv2.aruco.CharucoBoard(
            (self.columns, self.rows), self.square_mm, self.marker_mm, marker_dictionary()
        )


def marker_dictionary() -> cv2.aruco.Dictionary:
    """The markers on the board."""
    return cv2.aruco.getPredefinedDictionary(DICTIONARY)
