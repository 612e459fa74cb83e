"""The options and the output of `plugpilot workspace --optimise`."""

from __future__ import annotations

import functools
import math
import re
import sys
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import click
import tomlkit
from click.core import ParameterSource
from rich.console import Console

from server.cli.workspace_design import Design
from server.cli.workspace_text import plain_table
from twin.geometry import RobotGeometry
from twin.study.demands import SEARCHED, Bounds, Demand, Demands, SearchBounds
from twin.study.optimise import NoDesignError, Objective, optimise
from twin.study.search_report import SearchReport


@dataclass(frozen=True, slots=True)
class SearchRequest:
    """What the options ask for.

    Attributes:
        objective: What is to be made small.
        box_mm: Width, height, depth; None takes the robot's regular box.
        margin_mm: Stroke left at both ends.
        max_condition: Of the Jacobian.
        max_force_n: Of a carriage; None takes the limits of the actuators.
        bounds: How far the lengths may be varied.
        seed: Of the search.
    """

    objective: Objective
    box_mm: tuple[float, float, float] | None
    margin_mm: float
    max_condition: float
    max_force_n: float | None
    bounds: SearchBounds
    seed: int

    def demands(self, design: Design) -> Demands:
        """The demands on the robot."""
        box = design.geometry.regular_box
        width, height, depth = self.box_mm or (box.width_mm, box.height_mm, box.depth_mm)
        limits = design.actuators
        if self.max_force_n is not None:
            carriages = dict.fromkeys(("rho1_n", "rho2_n"), self.max_force_n)
            limits = limits.model_copy(update=carriages)
        return Demands(
            width_mm=width,
            height_mm=height,
            depth_mm=depth,
            margin_mm=self.margin_mm,
            max_condition=self.max_condition,
            loads=design.loads,
            limits=limits,
        )


class _Box(click.ParamType[tuple[float, float, float]]):
    name = "WxHxD"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[float, float, float]:
        parts = str(value).split("x")
        try:
            width, height, depth = map(float, parts)
        except ValueError:
            self.fail(f"{value!r} is not a box such as 200x200x20.", param, ctx)
        if not all(0 < size <= 10_000 for size in (width, height, depth)):
            self.fail(f"{value!r} has a size that is not between 0 and 10000 mm.", param, ctx)
        return width, height, depth


class _Vary(click.ParamType[tuple[str, Bounds]]):
    name = "NAME=LOW:HIGH"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[str, Bounds]:
        found = re.fullmatch(r"(\w+)=([^:]+)(?::(.+))?", str(value))
        if found is None or found[1] not in SEARCHED:
            names = ", ".join(SEARCHED)
            self.fail(f"{value!r} is not NAME=LOW:HIGH with a NAME of {names}.", param, ctx)
        try:
            low_mm, high_mm = float(found[2]), float(found[3] or found[2])
            return found[1], Bounds(low_mm=low_mm, high_mm=high_mm)
        except ValueError:
            self.fail(f"{value!r}: LOW and HIGH must be lengths in mm, LOW first.", param, ctx)


class _Finite(click.FloatRange):
    """A range that does not let NaN and infinity through."""

    def convert(
        self, value: float, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        number = float(super().convert(value, param, ctx))
        if not math.isfinite(number):
            self.fail(f"{value} is not a number.", param, ctx)
        return number


_OPTIONS = (
    click.option("--optimise", is_flag=True, help="Look for the smallest robot that serves a box."),
    click.option(
        "--objective",
        type=click.Choice([objective.value for objective in Objective]),
        default=Objective.AREA.value,
        show_default=True,
        help="What to make small: wall area in use, its width, or L2 alone.",
    ),
    click.option("--box", "box_mm", type=_Box(), help="To be served.  [the regular box]"),
    click.option(
        "--margin-mm",
        type=_Finite(min=0, max=1000),
        default=10.0,
        show_default=True,
        help="Stroke left at both ends of each carriage.",
    ),
    click.option(
        "--max-condition",
        type=_Finite(min=1, max=1e6),
        default=3.0,
        show_default=True,
        help="Largest condition number.",
    ),
    click.option(
        "--max-force-n",
        type=_Finite(min=0, min_open=True, max=100_000),
        help="Largest force of a carriage.  [the limits in [actuators]]",
    ),
    click.option(
        "--vary",
        multiple=True,
        type=_Vary(),
        help=f"Bounds of a length in mm: {', '.join(SEARCHED)}. May be given more than once.",
    ),
    click.option(
        "--max-base-width-mm", type=_Finite(min=0, min_open=True, max=10_000), help="Largest L2."
    ),
    click.option(
        "--max-stroke-mm", type=_Finite(min=0, min_open=True, max=10_000), help="Largest stroke."
    ),
    click.option("--seed", type=click.IntRange(min=0), default=0, show_default=True,
                 help="The same seed finds the same robot."),
)  # fmt: skip

_NAMES = (
    "optimise", "objective", "box_mm", "margin_mm", "max_condition", "max_force_n", "vary",
    "max_base_width_mm", "max_stroke_mm", "seed",
)  # fmt: skip


_DEMANDS = {
    Demand.LEG_LENGTH: "height left below upright legs",
    Demand.ABOVE_CARRIAGES: "height left above folded legs",
    Demand.STROKE: "stroke left",
    Demand.BASE_WIDTH: "width L2",
    Demand.SLIDE_TRAVEL: "slide travel left by the box",
    Demand.SLIDE_FORCE: "slide force",
    Demand.CONDITION: "condition number",
    Demand.CARRIAGE_FORCE: "carriage force",
    Demand.PARALLEL: "sine between the legs",
    Demand.SERIAL: "lean of the legs, d / L",
    Demand.PARALLELOGRAM: "sine in the parallelogram",
}


def search_options(command: Callable[..., None]) -> Callable[..., None]:
    """Add the options of the search; the command gets them as one `search`, None without them."""

    @functools.wraps(command)
    def gathered(**values: Any) -> None:  # noqa: ANN401 - what click hands over
        chosen = {name: values.pop(name) for name in _NAMES}
        command(**values, search=_request(chosen))

    for option in reversed(_OPTIONS):
        gathered = option(gathered)
    return gathered


def _request(values: dict[str, Any]) -> SearchRequest | None:
    if not values["optimise"]:
        context = click.get_current_context()
        for name in _NAMES:
            if context.get_parameter_source(name) is ParameterSource.COMMANDLINE:
                flag = name.removesuffix("_mm") if name == "box_mm" else name
                raise click.UsageError(f"--{flag.replace('_', '-')} goes with --optimise only.")
        return None
    changed: dict[str, Any] = dict(values["vary"])
    for bound, option in (
        ("base_width_max_mm", "max_base_width_mm"),
        ("stroke_max_mm", "max_stroke_mm"),
    ):
        if values[option] is not None:
            changed[bound] = values[option]
    return SearchRequest(
        objective=Objective(values["objective"]),
        box_mm=values["box_mm"],
        margin_mm=values["margin_mm"],
        max_condition=values["max_condition"],
        max_force_n=values["max_force_n"],
        bounds=SearchBounds(**changed),
        seed=values["seed"],
    )


def run_search(
    design: Design, request: SearchRequest, *, as_json: bool, console: Console
) -> tuple[Design, Demands]:
    """Search, print what was found, and hand it over with the demands it meets.

    Args:
        design: Where the search starts.
        request: What to look for.
        as_json: Print JSON instead of TOML.
        console: For the progress and the table.
    """
    demands = request.demands(design)
    try:
        with click.progressbar(
            length=100, label="searching", file=sys.stderr, hidden=not sys.stderr.isatty()
        ) as bar:
            found = optimise(
                design.geometry,
                demands,
                request.bounds,
                objective=request.objective,
                seed=request.seed,
                on_step=lambda done, total: bar.update(int(100 * done / total) - bar.pos),
            )
    except NoDesignError as error:
        click.echo(f"No such robot: {error}.\n{error.remedy}", err=True)
        sys.exit(1)
    report = SearchReport.of(found, request.seed)
    if as_json:
        click.echo(report.model_dump_json(indent=2))
    else:
        _print_table(console, report)
        click.echo(as_toml(found.geometry), nl=False)
    return design.model_copy(update={"geometry": found.geometry}), demands


def as_toml(geometry: RobotGeometry) -> str:
    """The section [geometry] of a robot, as --geometry and plugpilot.toml read it."""
    return tomlkit.dumps({"geometry": geometry.model_dump(mode="json")})


def _print_table(console: Console, report: SearchReport) -> None:
    start = "" if report.start_passed else ", which does not meet the demands"
    saved = 100 * (1 - report.value / report.start_value)
    console.print(
        f"[bold]Smallest {report.objective.replace('_', ' ')}[/]: {report.value:.0f} "
        f"{report.unit}; the start has {report.start_value:.0f} {report.unit}{start} "
        f"({saved:+.1f} % saved)."
    )
    table = plain_table("Demands", "demand", "asked", "start", "found", "", right=range(1, 4))
    for check in report.checks:
        sign = "<=" if check.at_most else ">="
        before = "-" if check.start is None else f"{check.start:.3f}"
        table.add_row(
            _DEMANDS[check.demand],
            f"{sign} {check.limit:g} {check.unit}",
            before if check.start_passed else f"[bold red]{before}[/]",
            f"{check.found:.3f}",
            "binding" if check.binding else "",
        )
    console.print(table)
