"""The board in pictures: where its corners are."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from server.calibration.camera.errors import MixedResolutionError, NoBoardError, WrongBoardError
from server.labels.board_layout import BoardLayout

FEWEST_CORNERS = 12
"""A view with fewer says little and is often a mistake."""

FEWEST_VIEWS = 6
FEWEST_MARKERS = 4


@dataclass(frozen=True, slots=True, eq=False)
class BoardView:
    """One picture that shows the board.

    Attributes:
        name: Of the picture.
        board_mm: Corners on the board, shape (n, 2), x right and y down from its upper left corner.
        image_px: The same corners in the picture, shape (n, 2), pixel centres at integers.
    """

    name: str
    board_mm: NDArray[np.float64]
    image_px: NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class BoardViews:
    """All pictures that show the board.

    Attributes:
        views: Those with enough corners.
        rejected: The others, with the reason.
        width_px: Of every picture.
        height_px: Of every picture.
    """

    views: tuple[BoardView, ...]
    rejected: tuple[tuple[str, str], ...]
    width_px: int
    height_px: int


def find_board(
    pictures: Iterable[tuple[str, NDArray[np.uint8]]], layout: BoardLayout
) -> BoardViews:
    """Look for the board in every picture.

    Args:
        pictures: Names and grey values, shape (height, width).
        layout: The board.

    Raises:
        MixedResolutionError: the pictures have different sizes.
        WrongBoardError: most pictures show markers that do not make up this board.
        NoBoardError: fewer than six pictures show enough of it.
    """
    detector = cv2.aruco.CharucoDetector(layout.board)
    corners_mm = np.asarray(layout.board.getChessboardCorners(), dtype=np.float64)[:, :2]
    views: list[BoardView] = []
    rejected: list[tuple[str, str]] = []
    strange = 0
    size: tuple[int, int] | None = None
    for name, image in pictures:
        if size is not None and image.shape != size:
            raise MixedResolutionError(
                f"{name} has {image.shape[1]} x {image.shape[0]} pixels, the ones before have "
                f"{size[1]} x {size[0]}."
            )
        size = (image.shape[0], image.shape[1])
        corners, numbers, _, marker_numbers = detector.detectBoard(image)
        found = 0 if numbers is None else len(numbers)
        if numbers is None or found < FEWEST_CORNERS:
            markers = 0 if marker_numbers is None else len(marker_numbers)
            strange += markers >= FEWEST_MARKERS and found == 0
            rejected.append((name, _why(found, markers)))
            continue
        views.append(
            BoardView(
                name,
                corners_mm[np.ravel(numbers)],
                np.asarray(corners, dtype=np.float64).reshape(-1, 2),
            )
        )
    if size is None:
        raise NoBoardError("There are no pictures.")
    if strange > len(views):
        raise WrongBoardError(
            f"{strange} pictures show markers, but no board of {layout.columns} x {layout.rows} "
            "squares."
        )
    if len(views) < FEWEST_VIEWS:
        raise NoBoardError(
            f"The board was found in {len(views)} of {len(views) + len(rejected)} pictures; at "
            f"least {FEWEST_VIEWS} are needed."
        )
    return BoardViews(tuple(views), tuple(rejected), size[1], size[0])


def _why(corners: int, markers: int) -> str:
    if corners == 0 and markers == 0:
        return "no board in it: too dark, blurred, or not in view"
    return f"only {corners} corners of the board are visible; {FEWEST_CORNERS} are needed"
