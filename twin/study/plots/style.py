"""How the figures look: sizes, fonts and colours of a printed page, and axes in millimetres."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.typing import RcKeyType

from twin.workspace import Limit

PAGE_WIDTH_MM = 174.0
"""Text width of a journal page with two columns."""

MM_PER_INCH = 25.4

INK = "#1a1a1a"
GREY = "#8a8a8a"
REGION_FILL = "#eaf1f8"
SQUARE = "#d55e00"
LARGEST = "#009e73"
ROBOT = "#3b3b3b"

LIMIT_COLOURS = {
    Limit.RHO1_MIN: "#0072b2",
    Limit.RHO1_MAX: "#56b4e9",
    Limit.RHO2_MIN: "#cc79a7",
    Limit.RHO2_MAX: "#e69f00",
    Limit.ASSEMBLY_SIDE: "#5b5b5b",
    Limit.LEG_LENGTH: "#000000",
    Limit.PARALLEL: "#d55e00",
    Limit.SERIAL: "#d55e00",
    Limit.PARALLELOGRAM: "#d55e00",
}
"""Colours that people with any kind of colour vision tell apart (M. Okabe, K. Ito, 2002)."""

LIMIT_NAMES = {
    Limit.RHO1_MIN: r"$\rho_1$ at the start of its stroke",
    Limit.RHO1_MAX: r"$\rho_1$ at the end of its stroke",
    Limit.RHO2_MIN: r"$\rho_2$ at the start of its stroke",
    Limit.RHO2_MAX: r"$\rho_2$ at the end of its stroke",
    Limit.ASSEMBLY_SIDE: "legs in line",
    Limit.LEG_LENGTH: "leg perpendicular to the rail",
    Limit.PARALLEL: "legs too nearly in line",
    Limit.SERIAL: "leg too nearly perpendicular",
    Limit.PARALLELOGRAM: "parallelogram too flat",
}

HALO = [withStroke(linewidth=2.2, foreground="white")]
"""Around letters that stand on lines."""

_SETTINGS: dict[RcKeyType, Any] = {
    "font.family": "STIXGeneral",
    "mathtext.fontset": "stix",
    "font.size": 9.0,
    "axes.titlesize": 10.0,
    "axes.labelsize": 9.0,
    "axes.linewidth": 0.6,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "xtick.labelsize": 8.0,
    "ytick.labelsize": 8.0,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "legend.fontsize": 8.0,
    "legend.frameon": False,
    "lines.solid_capstyle": "round",
    "figure.dpi": 100,
    "svg.fonttype": "path",  # so that the picture needs no font where it is opened
    "svg.hashsalt": "plugpilot",  # so that the same picture is the same file
}


@contextmanager
def printed_page() -> Iterator[None]:
    """Within it, figures are made and saved in this style, whatever the user's own settings."""
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(_SETTINGS)
        yield


def new_figure(height_mm: float, width_mm: float = PAGE_WIDTH_MM) -> Figure:
    """An empty figure whose parts make room for each other [mm on paper]."""
    return Figure(figsize=(width_mm / MM_PER_INCH, height_mm / MM_PER_INCH), layout="constrained")


def paper_height_mm(width_mm: float, size: tuple[float, float], *, besides_mm: float) -> float:
    """Height on paper of something drawn to scale.

    Args:
        width_mm: What it takes on paper along x.
        size: Its width and height in reality [mm].
        besides_mm: What stands above and below it on paper: title, labels, legend.
    """
    return width_mm * size[1] / size[0] + besides_mm


def legend_below(figure: Figure, columns: int = 3) -> None:
    """A legend of everything that has a name, under the axes."""
    figure.legend(loc="outside lower center", ncols=columns, handlelength=2.2, columnspacing=1.6)


def wall_axes(axes: Axes, title: str) -> None:
    """Make axes a view of the wall plane: the same scale both ways, labels with units."""
    axes.set_aspect("equal", adjustable="box")
    axes.set_xlabel(r"$x$ along the rail (mm)")
    axes.set_ylabel(r"$y$ away from the rail (mm)")
    axes.set_title(title, loc="left")
    axes.set_axisbelow(True)
    axes.grid(visible=True, color="#e6e6e6", linewidth=0.5)
