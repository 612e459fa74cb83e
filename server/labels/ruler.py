"""Rulers and cut marks: how a person sees that the printer has kept the size."""

from __future__ import annotations

from server.labels.drawing import Sheet

CUT_MARK_MM = 6.0
CUT_GAP_MM = 1.0
TICK_MM = 0.12
"""Width of a tick; its middle stands at the figure."""


def draw_ruler(sheet: Sheet, left_mm: float, bottom_mm: float, length_mm: int) -> None:
    """A horizontal ruler with a tick every millimetre and figures every ten."""
    ticks = []
    for mm in range(length_mm + 1):
        height_mm = 5.0 if mm % 10 == 0 else 3.6 if mm % 5 == 0 else 2.2
        x_mm = left_mm + mm
        ticks.append(((x_mm, bottom_mm), (x_mm, bottom_mm + height_mm)))
        if mm % 10 == 0:
            sheet.text(x_mm, bottom_mm + 6.0, str(mm), height_mm=2.4, align="center")
    sheet.lines(ticks, width_mm=TICK_MM)
    sheet.lines([((left_mm, bottom_mm), (left_mm + length_mm, bottom_mm))], width_mm=TICK_MM)
    sheet.text(left_mm + length_mm + 3.0, bottom_mm + 6.0, "mm", height_mm=2.4)


def draw_upright_ruler(sheet: Sheet, left_mm: float, bottom_mm: float, length_mm: int) -> None:
    """A vertical ruler: printers stretch the two directions differently."""
    ticks = []
    for mm in range(length_mm + 1):
        width_mm = 5.0 if mm % 10 == 0 else 3.6 if mm % 5 == 0 else 2.2
        y_mm = bottom_mm + mm
        ticks.append(((left_mm, y_mm), (left_mm + width_mm, y_mm)))
        if mm % 10 == 0:
            sheet.text(left_mm + 6.0, y_mm - 0.8, str(mm), height_mm=2.4)
    sheet.lines(ticks, width_mm=TICK_MM)
    sheet.lines([((left_mm, bottom_mm), (left_mm, bottom_mm + length_mm))], width_mm=TICK_MM)


def draw_cut_marks(sheet: Sheet, left_mm: float, bottom_mm: float, size_mm: float) -> None:
    """Two short lines at each corner of a square, outside of it."""
    lines = []
    for x_mm, outwards_x in ((left_mm, -1.0), (left_mm + size_mm, 1.0)):
        for y_mm, outwards_y in ((bottom_mm, -1.0), (bottom_mm + size_mm, 1.0)):
            for reach_x, reach_y in ((outwards_x, 0.0), (0.0, outwards_y)):
                near, far = CUT_GAP_MM, CUT_GAP_MM + CUT_MARK_MM
                lines.append(
                    (
                        (x_mm + near * reach_x, y_mm + near * reach_y),
                        (x_mm + far * reach_x, y_mm + far * reach_y),
                    )
                )
    sheet.lines(lines, width_mm=0.2)
