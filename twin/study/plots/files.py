"""All figures of a study, written to files."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Literal

from matplotlib.figure import Figure

from twin.geometry import RobotGeometry
from twin.study.demands import Demands
from twin.study.plots.deflection import draw_deflection
from twin.study.plots.lame import draw_lame
from twin.study.plots.maps import draw_maps
from twin.study.plots.placements import draw_placements
from twin.study.plots.singular import draw_singular
from twin.study.plots.style import printed_page
from twin.study.plots.workspace import draw_workspace

PictureFormat = Literal["png", "svg"]

FIGURES: dict[str, Callable[[RobotGeometry, Demands], Figure]] = {
    "workspace": lambda geometry, _: draw_workspace(geometry),
    "placements": lambda geometry, _: draw_placements(geometry),
    "lame": lambda geometry, _: draw_lame(geometry),
    "deflection": lambda geometry, _: draw_deflection(geometry),
    "singularities": lambda geometry, _: draw_singular(geometry),
    "maps": draw_maps,
}
"""The figures by the names of their files."""


def write_figures(
    geometry: RobotGeometry,
    folder: Path,
    picture_format: PictureFormat = "png",
    demands: Demands | None = None,
    *,
    dots_per_inch: int = 300,
) -> Iterator[Path]:
    """Draw every figure into a folder, which is made if it is not there; yields each file.

    The same robot gives the same files, to the last byte.

    Raises:
        OSError: the folder cannot be made or a file cannot be written.
        EmptyWorkspaceError: the robot reaches no position, so there is nothing to draw.
    """
    folder.mkdir(parents=True, exist_ok=True)
    metadata = {"Date": None} if picture_format == "svg" else {"Software": None}
    for name, draw in FIGURES.items():
        path = folder / f"{name}.{picture_format}"
        with printed_page():
            figure = draw(geometry, demands or Demands())
            figure.savefig(
                path,
                format=picture_format,
                dpi=dots_per_inch,
                metadata=metadata,
                bbox_inches="tight",
                pad_inches=0.04,
            )
        yield path
