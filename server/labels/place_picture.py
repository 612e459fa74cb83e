"""A small picture of where the label belongs: beside the socket, behind the flap. Not to scale."""

from __future__ import annotations

import math

from server.labels.drawing import TEXT, Sheet

PLACE_HEIGHT_MM = 46.0
WIDTH_MM, HEIGHT_MM = 84.0, 38.0
SOCKET_MM, LABEL_MM, PIN_MM = 25.0, 20.0, 3.2

# IEC 62196-2 type 2, seen from the front: places of the seven contacts from its centre, as parts
# of its diameter.
CONTACTS = (
    (-0.12, 0.20), (0.12, 0.20), (-0.25, 0.0), (0.0, 0.0), (0.25, 0.0), (-0.13, -0.20),
    (0.13, -0.20),
)  # fmt: skip


def draw_place(sheet: Sheet, left_mm: float, top_mm: float) -> None:
    """Draw an open charging bay with its socket and the label beside it."""
    bottom_mm = top_mm - HEIGHT_MM
    sheet.outline(left_mm, bottom_mm, WIDTH_MM, HEIGHT_MM, corner_mm=6.0, colour=TEXT)
    middle_mm = bottom_mm + 0.5 * HEIGHT_MM
    socket_mm = left_mm + 62.0
    _draw_socket(sheet, socket_mm, middle_mm)
    label_mm = left_mm + 26.0
    half_mm = 0.5 * LABEL_MM
    border_mm = 3.0
    sheet.outline(
        label_mm - half_mm - border_mm, middle_mm - half_mm - border_mm,
        LABEL_MM + 2 * border_mm, LABEL_MM + 2 * border_mm, corner_mm=0.5, colour=TEXT,
    )  # fmt: skip
    for dx_mm, dy_mm in ((-1, 1), (1, 1), (-1, -1)):
        _draw_finder(sheet, label_mm + dx_mm * 6.5, middle_mm + dy_mm * 6.5)
    tip_mm = middle_mm + half_mm + 1.0
    x_mm = left_mm + 6.5
    sheet.lines(
        [
            ((x_mm, middle_mm - 5.0), (x_mm, tip_mm)),
            ((x_mm - 1.6, tip_mm - 2.2), (x_mm, tip_mm)),
            ((x_mm + 1.6, tip_mm - 2.2), (x_mm, tip_mm)),
        ],
        width_mm=0.4,
        colour=TEXT,
    )
    sheet.text(x_mm, middle_mm - 9.5, "up", height_mm=2.6, align="center")
    sheet.text(
        left_mm, bottom_mm - 5.0,
        "Middle of the label 120 mm to the left of the socket's; tell PlugPilot if it is not.",
        height_mm=2.6,
    )  # fmt: skip


def _draw_socket(sheet: Sheet, x_mm: float, y_mm: float) -> None:
    radius_mm = 0.5 * SOCKET_MM
    flat = math.radians(50.0)  # the shell is flat on top
    angles = [math.pi / 2 + flat + 2 * (math.pi - flat) * i / 48 for i in range(49)]
    shell = [(x_mm + radius_mm * math.cos(a), y_mm + radius_mm * math.sin(a)) for a in angles]
    sheet.lines(zip(shell, [*shell[1:], shell[0]], strict=True), width_mm=0.3, colour=TEXT)
    for part_x, part_y in CONTACTS:
        centre_x, centre_y = x_mm + part_x * SOCKET_MM, y_mm + part_y * SOCKET_MM
        sheet.circle(centre_x, centre_y, PIN_MM, colour=TEXT, line_mm=0.25)


def _draw_finder(sheet: Sheet, x_mm: float, y_mm: float) -> None:
    sheet.outline(x_mm - 3.0, y_mm - 3.0, 6.0, 6.0, corner_mm=0.01, line_mm=0.9)
    sheet.rectangles([(x_mm - 1.4, y_mm - 1.4, 2.8, 2.8)])
