"""`plugpilot label`: print the label of a vehicle, or the board that calibrates a camera."""

from __future__ import annotations

from pathlib import Path

import click
import numpy as np
from numpy.typing import NDArray

from server.config import Option, load_settings
from server.labels.board_layout import BoardLayout
from server.labels.board_sheet import draw_board_sheet
from server.labels.drawing import Paper
from server.labels.key_file import load_label_key
from server.labels.label_sheet import LabelPrint, draw_label_sheet
from server.labels.payload import label_text
from server.vision.markers.april_tags import tag_modules
from twin.qr_label import label_modules

DEFAULT_SIZE_MM = 60.0
TAG_QUIET_ZONE_MODULES = 2
PAPERS = {paper.name.lower(): paper for paper in Paper}


@click.command()
@click.argument("vehicle", required=False)
@click.option("--name", help="What people call the vehicle.  [its id]")
@click.option(
    "--size-mm", type=float, default=DEFAULT_SIZE_MM, show_default=True, help="Side of the code."
)
@click.option("--board", is_flag=True, help="The ChArUco board for the camera instead of a label.")
@click.option("--tag", help="An AprilTag such as tag36h11:17 instead of a QR code.")
@click.option("--paper", type=click.Choice(list(PAPERS)), default="a4", show_default=True)
@click.option(
    "--output",
    type=click.Path(path_type=Path, dir_okay=False),
    help="File that ends in .pdf, .svg or .png.  [plugpilot-label-<vehicle>.pdf]",
)
@click.option("--config", type=click.Path(path_type=Path), help="Configuration file.")
@click.option("--data-dir", help="Folder of this robot's data, with its key.  [storage.data_dir]")
def label(
    *,
    vehicle: str | None,
    name: str | None,
    size_mm: float,
    board: bool,
    tag: str | None,
    paper: str,
    output: Path | None,
    config: Path | None,
    data_dir: str | None,
) -> None:
    """Make a sheet with the label of VEHICLE, ready to be printed at 100 %.

    VEHICLE is the id that PlugPilot knows the vehicle by. The label is signed with the key in the
    data folder, so that the robot tells it from labels that others have made; print it with the
    same data folder that `plugpilot serve` uses.
    """
    if board:
        if vehicle or tag:
            raise click.UsageError("--board is the camera's; it takes no vehicle and no --tag.")
        path = output or Path("plugpilot-board.pdf")
        draw_board_sheet(BoardLayout(), PAPERS[paper]).save(path, "PlugPilot camera board")
        click.echo(f"{path}: print it at 100 % and check its ruler.")
        return
    if vehicle is None:
        raise click.UsageError("Name the vehicle: plugpilot label zoe. Or --board for the camera.")
    if tag is None:
        settings = load_settings(config, [Option("--data-dir", "storage.data_dir", data_dir)])
        text = label_text(vehicle, load_label_key(settings.storage.data_dir))
        shown = LabelPrint(name or vehicle, text, label_modules(text), size_mm)
    else:
        shown = LabelPrint(name or vehicle, tag, _tag(tag), size_mm, TAG_QUIET_ZONE_MODULES)
    path = output or Path(f"plugpilot-label-{vehicle}.pdf")
    draw_label_sheet(shown, PAPERS[paper]).save(path, f"PlugPilot label {vehicle}")
    click.echo(f"{path}: {shown.text}, black square {size_mm:g} mm. Print it at 100 %.")


def _tag(text: str) -> NDArray[np.bool_]:
    try:
        return tag_modules(text)
    except ValueError as error:
        raise click.BadParameter(f"{error}.", param_hint="--tag") from error
