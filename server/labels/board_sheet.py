"""The sheet with the ChArUco board by which a camera is calibrated."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from server.labels.board_layout import BoardLayout, marker_dictionary
from server.labels.drawing import Paper, Sheet
from server.labels.errors import LabelSizeError
from server.labels.ruler import draw_ruler

MARKER_MODULES = 7
"""Side of a marker of that dictionary with its black border."""

MARGIN_MM = 14.0
TEXT_MM = 34.0


def draw_board_sheet(layout: BoardLayout, paper: Paper = Paper.A4) -> Sheet:
    """Draw the board.

    Raises:
        LabelSizeError: it does not fit onto the paper.
    """
    width_mm, height_mm = layout.columns * layout.square_mm, layout.rows * layout.square_mm
    room_mm = (paper.width_mm - 2 * MARGIN_MM, paper.height_mm - 2 * MARGIN_MM - TEXT_MM)
    if width_mm > room_mm[0] or height_mm > room_mm[1]:
        raise LabelSizeError(
            f"A board of {width_mm:g} x {height_mm:g} mm does not fit onto the paper; there is "
            f"room for {room_mm[0]:.0f} x {room_mm[1]:.0f} mm."
        )
    sheet = Sheet.blank(paper)
    left_mm = 0.5 * (paper.width_mm - width_mm)
    top_mm = paper.height_mm - MARGIN_MM
    square_mm = layout.square_mm
    sheet.rectangles(
        (left_mm + column * square_mm, top_mm - (row + 1) * square_mm, square_mm, square_mm)
        for row in range(layout.rows)
        for column in range(layout.columns)
        if (row + column) % 2 == 0
    )
    for number, corners in zip(_ids(layout.board), layout.board.getObjPoints(), strict=True):
        x_mm, y_mm = float(corners[0][0]), float(corners[0][1])  # upper left, y down
        sheet.modules(_marker(number), left_mm + x_mm, top_mm - y_mm, layout.marker_mm)
    below_mm = top_mm - height_mm
    sheet.text(
        left_mm, below_mm - 7.0,
        f"PlugPilot camera board   ·   {layout.columns} x {layout.rows} squares of "
        f"{square_mm:g} mm, markers {layout.marker_mm:g} mm", height_mm=3.2, bold=True,
    )  # fmt: skip
    sheet.text(
        left_mm, below_mm - 12.5,
        "Print at 100 %, check the ruler, and glue the sheet onto something flat and stiff.",
        height_mm=2.8,
    )  # fmt: skip
    draw_ruler(sheet, left_mm, below_mm - 26.0, 100)
    return sheet


def _ids(board: cv2.aruco.CharucoBoard) -> list[int]:
    return [int(number) for number in np.asarray(board.getIds()).ravel()]


def _marker(number: int) -> NDArray[np.bool_]:
    image = marker_dictionary().generateImageMarker(number, MARKER_MODULES, borderBits=1)
    return np.asarray(image == 0, dtype=np.bool_)
