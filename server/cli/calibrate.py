"""`plugpilot calibrate`: find the numbers of this robot's parts."""

from __future__ import annotations

import json as json_format
import math
import sys
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import click
import numpy as np
from numpy.typing import NDArray

from server.calibration.camera.board_views import BoardViews, find_board
from server.calibration.camera.calibration_file import keep
from server.calibration.camera.coverage import coverage_map
from server.calibration.camera.solve import CameraSolution, solve_camera
from server.calibration.camera.verdict import Verdict, judge
from server.calibration.grade import Grade
from server.config import Option, load_settings
from server.labels.board_layout import BoardLayout
from server.vision.image_file import load_grey_image

FOLDER = "calibrations"
SHADES = " .:*#"
"""From no corner to many."""


@click.group()
def calibrate() -> None:
    """Find the numbers of this robot's parts."""


@calibrate.command()
@click.argument(
    "pictures", metavar="PICTURE...", nargs=-1, required=True, type=click.Path(path_type=Path)
)
@click.option(
    "--square-mm", type=click.FloatRange(5, 200), default=BoardLayout().square_mm,
    show_default=True, help="Measured side of a square of the printed board.",
)  # fmt: skip
@click.option("--config", type=click.Path(path_type=Path), help="Configuration file.")
@click.option("--data-dir", help="Where calibrations are kept.  [storage.data_dir]")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
def camera(
    pictures: tuple[Path, ...],
    square_mm: float,
    config: Path | None,
    data_dir: str | None,
    *,
    as_json: bool,
) -> None:
    """Calibrate the camera from pictures of the board that `plugpilot label --board` prints.

    Fifteen to thirty pictures in the mode and with the focus that the robot uses: the board in all
    corners of the picture, near and far, some tilted by 20 to 40 degrees, some turned by 90. Every
    calibration is kept as a file of its own; camera.calibration in the configuration chooses one.

    Exit status: 0 for a good or usable calibration, 1 for a bad one, 2 when there is none.
    """
    settings = load_settings(config, [Option("--data-dir", "storage.data_dir", data_dir)])
    drawn = BoardLayout()
    scale = square_mm / drawn.square_mm
    layout = BoardLayout(square_mm=square_mm, marker_mm=scale * drawn.marker_mm)
    found = find_board(_read(pictures, quiet=as_json), layout)
    solution = solve_camera(found)
    used = {view.name for view in solution.views if view.used}
    coverage = coverage_map(
        [view for view in found.views if view.name in used], found.width_px, found.height_px
    )
    verdict = judge(solution, coverage)
    path = keep(settings.storage.data_dir / FOLDER, solution, verdict, datetime.now(UTC))
    if as_json:
        click.echo(json_format.dumps(_json(path, found, solution, coverage, verdict)))
    else:
        click.echo("\n".join(_lines(path, found, solution, coverage, verdict)))
    if verdict.grade is Grade.BAD:
        sys.exit(1)


def _read(pictures: tuple[Path, ...], *, quiet: bool) -> Iterator[tuple[str, NDArray[np.uint8]]]:
    with click.progressbar(
        pictures, label="Looking for the board", file=sys.stderr, hidden=quiet
    ) as bar:
        for path in bar:
            yield path.name, load_grey_image(path)


def _lines(
    path: Path,
    found: BoardViews,
    solution: CameraSolution,
    coverage: NDArray[np.int_],
    verdict: Verdict,
) -> Iterator[str]:
    """The result for a person."""
    camera, sigma = solution.camera, solution.sigma
    widest = max(len(name) for name in [*(v.name for v in solution.views), "picture"])
    yield f"{'picture':{widest}}  residual  tilt  distance"
    for view in solution.views:
        yield (
            f"{view.name:{widest}}  {view.rms_px:5.3f} px  {math.degrees(view.tilt_rad):3.0f}°  "
            f"{view.distance_mm:5.0f} mm{'' if view.used else '   left out'}"
        )
    for name, reason in found.rejected:
        yield f"{name:{widest}}  not used: {reason}"
    yield ""
    yield f"{camera.width} x {camera.height} px"
    for name in ("fx", "fy", "cx", "cy"):
        yield f"{name}  {getattr(camera, name):9.2f} +- {sigma[name]:.2f} px"
    for name in ("k1", "k2", "p1", "p2", "k3"):
        yield f"{name}  {getattr(camera, name):9.5f} +- {sigma[name]:.5f}"
    yield f"residual {solution.rms_px:.3f} px, on pictures held back {solution.check_px:.3f} px"
    yield ""
    yield "Where the board has been in the picture:"
    most = max(1, int(coverage.max()))
    for row in coverage:
        shades = (SHADES[math.ceil(count / most * (len(SHADES) - 1))] for count in row)
        yield "  |" + "".join(2 * shade for shade in shades) + "|"
    yield ""
    yield {
        Grade.GOOD: "Good: use it.",
        Grade.USABLE: "Usable, but could be better:",
        Grade.BAD: "Not good enough for the robot:",
    }[verdict.grade]
    for remark in verdict.remarks:
        yield f"- {remark}"
    yield f"Kept as {path}; camera.calibration in the configuration chooses it."


def _json(
    path: Path,
    found: BoardViews,
    solution: CameraSolution,
    coverage: NDArray[np.int_],
    verdict: Verdict,
) -> dict[str, Any]:
    return {
        "file": str(path),
        "camera": solution.camera.model_dump(),
        "sigma": solution.sigma,
        "rms_px": solution.rms_px,
        "check_px": solution.check_px,
        "views": [
            {
                "picture": view.name,
                "rms_px": view.rms_px,
                "tilt_rad": view.tilt_rad,
                "distance_mm": view.distance_mm,
                "used": view.used,
            }
            for view in solution.views
        ],
        "rejected": [{"picture": name, "reason": reason} for name, reason in found.rejected],
        "coverage": coverage.tolist(),
        "verdict": verdict.grade.value,
        "remarks": list(verdict.remarks),
    }
