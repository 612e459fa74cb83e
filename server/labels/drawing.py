"""A sheet of paper to draw on in millimetres, saved as PDF, SVG or PNG at its true size.

The origin is the lower left corner of the paper, x to the right, y up.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import BoxStyle, Circle, FancyBboxPatch
from numpy.typing import NDArray

from server.labels.errors import SheetError

MM_PER_INCH = 25.4
PRINT_DPI = 600
INK = "#000000"
"""Pure black: a grey would be printed as a pattern of dots."""

TEXT = "#333333"
FORMATS = (".pdf", ".svg", ".png")

Point = tuple[float, float]


class Paper(Enum):
    """Size of the sheet, width and height [mm]."""

    A4 = (210.0, 297.0)
    LETTER = (215.9, 279.4)

    @property
    def width_mm(self) -> float:
        """Of the upright sheet."""
        return self.value[0]

    @property
    def height_mm(self) -> float:
        """Of the upright sheet."""
        return self.value[1]


@dataclass(frozen=True, slots=True)
class Sheet:
    """One sheet.

    Attributes:
        figure: As large as the paper.
        axes: Cover the whole of it, in mm.
    """

    figure: Figure
    axes: Axes

    @classmethod
    def blank(cls, paper: Paper) -> Sheet:
        """An empty sheet."""
        size_inch = (paper.width_mm / MM_PER_INCH, paper.height_mm / MM_PER_INCH)
        figure = Figure(figsize=size_inch)
        axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        axes.set_xlim(0.0, paper.width_mm)
        axes.set_ylim(0.0, paper.height_mm)
        axes.set_axis_off()
        return cls(figure, axes)

    def modules(
        self, modules: NDArray[np.bool_], left_mm: float, top_mm: float, size_mm: float
    ) -> None:
        """Draw a square pattern.

        Args:
            modules: True is black, shape (n, n), row 0 on top.
            left_mm: Left edge.
            top_mm: Upper edge.
            size_mm: Side of the whole pattern.
        """
        side_mm = size_mm / modules.shape[0]
        runs = [
            _rectangle(
                left_mm + start * side_mm, top_mm - (row + 1) * side_mm,
                (end - start) * side_mm, side_mm,
            )
            for row, line in enumerate(modules)
            for start, end in _black_runs(line)
        ]  # fmt: skip
        # neighbouring rows overlap by nothing: a hair of ink keeps viewers from showing seams,
        # but it would make black modules grow; so the shapes are filled without smoothing
        self.axes.add_collection(
            PolyCollection(runs, facecolors=INK, edgecolors="none", antialiaseds=False)
        )

    def rectangles(self, rectangles: Iterable[tuple[float, float, float, float]]) -> None:
        """Fill rectangles (left, bottom, width, height) with ink."""
        shapes = [_rectangle(*rectangle) for rectangle in rectangles]
        self.axes.add_collection(
            PolyCollection(shapes, facecolors=INK, edgecolors="none", antialiaseds=False)
        )

    def lines(
        self, lines: Iterable[tuple[Point, Point]], width_mm: float = 0.15, colour: str = INK
    ) -> None:
        """Draw straight lines."""
        self.axes.add_collection(
            LineCollection(
                list(lines), colors=colour, linewidths=_points(width_mm), capstyle="butt"
            )
        )

    def outline(
        self,
        left_mm: float,
        bottom_mm: float,
        width_mm: float,
        height_mm: float,
        *,
        corner_mm: float,
        colour: str = INK,
        line_mm: float = 0.3,
    ) -> None:
        """Draw a rectangle with round corners."""
        self.axes.add_patch(
            FancyBboxPatch(
                (left_mm + corner_mm, bottom_mm + corner_mm),
                width_mm - 2 * corner_mm, height_mm - 2 * corner_mm,
                boxstyle=BoxStyle.Round(pad=corner_mm), fill=False, edgecolor=colour,
                linewidth=_points(line_mm),
            )
        )  # fmt: skip

    def circle(
        self, x_mm: float, y_mm: float, diameter_mm: float, *, colour: str, line_mm: float
    ) -> None:
        """Draw a circle about a point."""
        self.axes.add_patch(
            Circle(
                (x_mm, y_mm), 0.5 * diameter_mm,
                fill=False, edgecolor=colour, linewidth=_points(line_mm),
            )
        )  # fmt: skip

    def text(
        self,
        x_mm: float,
        y_mm: float,
        text: str,
        *,
        height_mm: float = 3.2,
        align: str = "left",
        bold: bool = False,
        colour: str = TEXT,
    ) -> None:
        """Write; the line's base stands at y."""
        self.axes.text(
            x_mm, y_mm, text, fontsize=_points(height_mm), ha=align, va="baseline", color=colour,
            fontweight="bold" if bold else "normal", family="DejaVu Sans", linespacing=1.45,
            parse_math=False,
        )  # fmt: skip

    def save(self, path: Path, title: str) -> None:
        """Write the sheet in the format that the name ends in.

        The same sheet gives the same bytes: no date, no random names.

        Raises:
            SheetError: there is no such format, or the file cannot be written.
        """
        if path.suffix.lower() not in FORMATS:
            raise SheetError(f"{path.name} ends in none of {', '.join(FORMATS)}.")
        format_ = path.suffix.lower().removeprefix(".")
        metadata: dict[str, str | None] = {"Title": title}
        metadata |= {"pdf": {"CreationDate": None}, "svg": {"Date": None}}.get(format_, {})
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            with rc_context({"svg.hashsalt": "label", "pdf.fonttype": 42}):
                self.figure.savefig(path, format=format_, dpi=PRINT_DPI, metadata=metadata)
        except OSError as error:
            raise SheetError(f"{path} cannot be written: {error.strerror}.") from error


def _rectangle(left: float, bottom: float, width: float, height: float) -> list[Point]:
    right, top = left + width, bottom + height
    return [(left, bottom), (right, bottom), (right, top), (left, top)]


def _black_runs(line: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """First and behind-last column of every run of black modules."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], line, [False])).astype(np.int8)))
    return [(int(start), int(end)) for start, end in edges.reshape(-1, 2)]


def _points(length_mm: float) -> float:
    return length_mm * 72.0 / MM_PER_INCH
