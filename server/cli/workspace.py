"""`plugpilot workspace`: the design of the robot, its figures, and a smaller robot."""

from __future__ import annotations

import json
from pathlib import Path
from typing import ClassVar, Literal

import click

from server.cli.workspace_design import Design, load_design
from server.cli.workspace_search import SearchRequest, run_search, search_options
from server.cli.workspace_text import console_for, print_report
from server.errors import PlugPilotError
from twin.study.analyse import study
from twin.study.demands import Demands
from twin.study.report import StudyReport
from twin.study.search_report import SearchReport

PictureFormat = Literal["png", "svg"]


class PicturesNotWrittenError(PlugPilotError):
    """A picture cannot be written."""

    code: ClassVar[str] = "pictures_not_written"
    title: ClassVar[str] = "The pictures cannot be written"
    remedy: ClassVar[str] = "Name a folder that you may write into."


@click.command()
@click.option(
    "--geometry",
    "file",
    metavar="FILE",
    type=click.Path(path_type=Path),
    help="TOML file with the section [geometry], and [loads] and [actuators] if they differ.  "
    "[the settings in force]",
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object; see --schema.")
@click.option("--schema", is_flag=True, help="Print the JSON schema of --json, and nothing else.")
@click.option(
    "--plot",
    "folder",
    metavar="DIR",
    type=click.Path(path_type=Path),
    help="Draw the figures into a folder: workspace, placements, Lame curves, deflection, "
    "singular postures and maps.",
)
@click.option(
    "--format",
    "picture_format",
    type=click.Choice(["png", "svg"]),
    default="png",
    show_default=True,
    help="Of the pictures.",
)
@search_options
def workspace(
    file: Path | None,
    *,
    as_json: bool,
    schema: bool,
    folder: Path | None,
    picture_format: PictureFormat,
    search: SearchRequest | None,
) -> None:
    """Study the robot's design: workspace, margins, forces, requirements.

    With --optimise: look for the smallest robot that serves a box, and print it as TOML that
    --geometry reads again. What was found goes to the error output, so that the TOML can be
    redirected. Exit status 1 if there is no such robot.
    """
    if schema:
        _print_schema(searching=search is not None)
        return
    design = load_design(file)
    demands = Demands(loads=design.loads, limits=design.actuators)
    if search is not None:
        console = console_for(stderr=True)
        design, demands = run_search(design, search, as_json=as_json, console=console)
    else:
        report = study(design.geometry, demands)
        if as_json:
            click.echo(report.model_dump_json(indent=2))
        else:
            print_report(console_for(), report)
    if folder is not None:
        _plot(design, demands, folder, picture_format)


def _print_schema(*, searching: bool) -> None:
    model = SearchReport if searching else StudyReport
    click.echo(json.dumps(model.model_json_schema(mode="serialization"), indent=2))


def _plot(design: Design, demands: Demands, folder: Path, picture_format: PictureFormat) -> None:
    # imported late: only who draws waits for matplotlib
    from twin.study.plots.files import write_figures  # noqa: PLC0415

    try:
        for path in write_figures(design.geometry, folder, picture_format, demands):
            click.echo(f"wrote {path}", err=True)
    except OSError as error:
        msg = f"The pictures cannot be written into {folder} ({error.strerror})."
        raise PicturesNotWrittenError(msg, path=str(folder)) from error
