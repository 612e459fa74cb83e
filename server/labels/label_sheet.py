"""The sheet with a vehicle's label: the code at its true size, and how to use it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from server.labels.drawing import TEXT, Paper, Sheet
from server.labels.errors import LabelSizeError
from server.labels.place_picture import PLACE_HEIGHT_MM, draw_place
from server.labels.ruler import draw_cut_marks, draw_ruler, draw_upright_ruler
from twin.qr_label import QUIET_ZONE_MODULES

SMALLEST_MM, LARGEST_MM = 30.0, 120.0
MARGIN_MM = 20.0
RULER_MM = 100
UPRIGHT_RULER_MM = 50
STEP_MM = 7.0

STEPS = (
    ("Print", "at 100 % (“actual size”, no “fit to page”), black on white matt paper."),
    ("Measure", "both rulers with a real one. 100 mm must be 100 mm, or the robot misses."),
    ("Cut", "along the marks. The white border belongs to the label."),
    ("Stick it flat", "beside the charging socket, under the flap, upright as here: arrow up."),
    ("Cover it", "with clear matt foil if it can get wet. Shiny foil mirrors the lamp."),
    ("Enter", "the side of the black square in PlugPilot if yours measures otherwise."),
)


@dataclass(frozen=True, slots=True, eq=False)
class LabelPrint:
    """What a sheet shows.

    Attributes:
        name: What people call the vehicle.
        text: What the code says.
        modules: The pattern, True is black, shape (n, n).
        size_mm: Its side without the white border.
        quiet_zone_modules: Width of the white border.
    """

    name: str
    text: str
    modules: NDArray[np.bool_]
    size_mm: float
    quiet_zone_modules: int = QUIET_ZONE_MODULES

    @property
    def border_mm(self) -> float:
        """Width of the white border."""
        return self.quiet_zone_modules * self.size_mm / len(self.modules)


def draw_label_sheet(label: LabelPrint, paper: Paper = Paper.A4) -> Sheet:
    """Draw a sheet.

    Raises:
        LabelSizeError: the label is too small to be seen or too large for the paper.
    """
    _check_size(label.size_mm)
    sheet = Sheet.blank(paper)
    top_mm = paper.height_mm - MARGIN_MM
    sheet.text(MARGIN_MM, top_mm - 6.0, "PlugPilot", height_mm=6.5, bold=True, colour="#000000")
    sheet.text(MARGIN_MM, top_mm - 14.0, f"Label for {_shortened(label.name)}", height_mm=4.5)

    whole_mm = label.size_mm + 2 * label.border_mm
    left_mm = 0.5 * (paper.width_mm - whole_mm)
    bottom_mm = top_mm - 30.0 - whole_mm
    draw_cut_marks(sheet, left_mm, bottom_mm, whole_mm)
    code_top_mm = bottom_mm + whole_mm - label.border_mm
    sheet.modules(label.modules, left_mm + label.border_mm, code_top_mm, label.size_mm)
    _draw_up_arrow(sheet, 0.5 * paper.width_mm, bottom_mm + whole_mm + 2.5)
    sheet.text(
        0.5 * paper.width_mm, bottom_mm - 11.0,
        f"{label.text}   ·   black square {label.size_mm:g} mm", align="center", height_mm=2.6,
    )  # fmt: skip

    below_mm = bottom_mm - 29.0
    draw_ruler(sheet, MARGIN_MM, below_mm, RULER_MM)
    draw_upright_ruler(sheet, paper.width_mm - MARGIN_MM - 12.0, below_mm - 42.0, UPRIGHT_RULER_MM)
    steps_end_mm = _draw_steps(sheet, below_mm - 8.0)
    if steps_end_mm > MARGIN_MM + PLACE_HEIGHT_MM:
        draw_place(sheet, MARGIN_MM + 34.0, steps_end_mm - 6.0)
    return sheet


def _check_size(size_mm: float) -> None:
    if not SMALLEST_MM <= size_mm <= LARGEST_MM:  # also refuses NaN
        raise LabelSizeError(
            f"A label of {size_mm:g} mm cannot be used; {SMALLEST_MM:g} to {LARGEST_MM:g} mm can."
        )


def _draw_up_arrow(sheet: Sheet, x_mm: float, bottom_mm: float) -> None:
    """Outside of what is cut off: the code itself looks the same to people in four ways."""
    tip_mm = bottom_mm + 7.0
    sheet.lines(
        [
            ((x_mm, bottom_mm), (x_mm, tip_mm)),
            ((x_mm - 2.0, tip_mm - 2.6), (x_mm, tip_mm)),
            ((x_mm + 2.0, tip_mm - 2.6), (x_mm, tip_mm)),
        ],
        width_mm=0.5,
        colour=TEXT,
    )
    sheet.text(x_mm + 4.0, bottom_mm + 2.2, "up", height_mm=3.0)


def _draw_steps(sheet: Sheet, top_mm: float) -> float:
    """Write the steps; returns the height of the last one."""
    for number, (verb, rest) in enumerate(STEPS, start=1):
        y_mm = top_mm - STEP_MM * number
        sheet.text(MARGIN_MM, y_mm, f"{number}", bold=True, height_mm=3.2, colour="#000000")
        sheet.text(MARGIN_MM + 6.0, y_mm, verb, bold=True, height_mm=3.0, colour="#000000")
        sheet.text(MARGIN_MM + 34.0, y_mm, rest, height_mm=3.0)
    return top_mm - STEP_MM * len(STEPS)


def _shortened(name: str, most: int = 40) -> str:
    return name if len(name) <= most else f"{name[: most - 1]}…"
