"""A study of a robot as tables for a person."""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Console
from rich.table import Table

from twin.study.report import ActuatorForce, RegularSquare, StrokeMarginsMm, StudyReport
from twin.study.requirements import Outcome

MIN_WIDTH = 100
"""Tables need this many columns; a narrower window breaks their lines."""

LIMITS = ("rho1_min", "rho1_max", "rho2_min", "rho2_max")
LIMIT_TITLES = ("rho1 start", "rho1 end", "rho2 start", "rho2 end")
CORNERS = ("lower left", "lower right", "upper right", "upper left")

OUTCOME_STYLES = {
    Outcome.MET: ("met", "green"),
    Outcome.NOT_MET: ("not met", "bold red"),
    Outcome.NOT_DECIDABLE: ("not decidable", "yellow"),
}

VALIDITY = {
    "interpolated": "between the published points",
    "outside_table": "beyond the published points: the nearest one, extrapolated",
    "another_robot": "published for another robot: an order of magnitude only",
}


def console_for(*, stderr: bool = False) -> Console:
    """Where text goes; as wide as the tables need if it goes into a file or a pipe."""
    console = Console(stderr=stderr, highlight=False)
    if not console.is_terminal:
        console.width = MIN_WIDTH + 20
    return console


def print_report(console: Console, report: StudyReport) -> None:
    """Print the whole study."""
    square, largest = report.regular_square, report.largest_square
    console.print(_workspace(report))
    console.print()
    console.print(_corners(square))
    console.print()
    if report.forces:
        console.print(_forces(report.forces))
        console.print()
    if report.lame:
        console.print(_lame(report))
        console.print()
    console.print(_paper(report))
    console.print()
    _print_requirements(console, report)
    if not square.fits:
        console.print(
            f"\n[bold red]The regular square is not inside.[/] The largest one has "
            f"{largest.side_mm:.1f} mm about ({largest.center_mm[0]:.1f}, "
            f"{largest.center_mm[1]:.1f}): change \\[geometry.regular_box], the offsets or the "
            "strokes."
        )


def plain_table(title: str, *columns: str, right: Sequence[int] = ()) -> Table:
    """A table in the style of all tables here; numbers are set to the right."""
    table = Table(title=title, title_justify="left", title_style="bold", box=None, pad_edge=False)
    for number, column in enumerate(columns):
        table.add_column(column, justify="right" if number in right else "left")
    return table


def _workspace(report: StudyReport) -> Table:
    square, largest, box = report.regular_square, report.largest_square, report.box
    table = plain_table("Workspace of the platform (mm)", "", "")
    table.show_header = False
    add = table.add_row
    add("area", f"{report.area_mm2:.1f} mm2")
    add("largest square", f"{largest.side_mm:.2f} about {_point(largest.center_mm)}, touches "
        + ", ".join(largest.contacts))  # fmt: skip
    size = f"{square.width_mm:g} x {square.height_mm:g} about {_point(square.center_mm)}"
    state = "inside" if square.fits else "[bold red]not inside[/]"
    add("regular square", f"{size}: {state}, {_least(square.margins_mm)}")
    add("its placements", f"{report.placements.area_mm2:.1f} mm2 of centres")
    fits = "inside" if box.fits else "[bold red]not inside[/]"
    deepest = "" if box.deepest_mm is None else f", up to {box.deepest_mm:.1f} deep"
    add("box of the plug", f"{box.width_mm:g} x {box.height_mm:g} x {box.depth_mm:g} about "
        f"{_point(box.tip_center_mm)}: {fits}, {_least(box.margins_mm)}{deepest}")  # fmt: skip
    if report.worst_condition is not None:
        worst = report.worst_condition
        add("condition number", f"at most {worst.value:.3f}, at y = {worst.at_mm[1]:.1f}")
    if report.largest_force is not None:
        force = report.largest_force
        add("largest force", f"{force.actuator}, {force.case}: {abs(force.force_n):.1f} N of "
            f"{force.limit_n:g} N")  # fmt: skip
    if report.deflection is not None:
        sag = report.deflection
        add("deflection", f"alpha {sag.alpha_mm:.3f}, beta {sag.beta_mm:.3f} at most; "
            + VALIDITY[sag.validity.value])  # fmt: skip
    return table


def _corners(square: RegularSquare) -> Table:
    table = plain_table(
        "Stroke left in the corners of the regular square (mm)",
        "corner", "x", "y", "rho1", "rho2", *LIMIT_TITLES, right=range(1, 9),
    )  # fmt: skip
    for name, corner in zip(CORNERS, square.corners, strict=True):
        place = [f"{corner.position_mm[0]:.1f}", f"{corner.position_mm[1]:.1f}"]
        if corner.rho1_mm is None or corner.rho2_mm is None or corner.margins_mm is None:
            table.add_row(name, *place, "[red]out of reach[/]")
            continue
        joints = [f"{corner.rho1_mm:.1f}", f"{corner.rho2_mm:.1f}"]
        table.add_row(name, *place, *joints, *_strokes(corner.margins_mm))
    table.add_row("[bold]whole square", "", "", "", "", *_strokes(square.margins_mm))
    return table


def _forces(forces: Sequence[ActuatorForce]) -> Table:
    table = plain_table(
        "Largest static forces over the regular square (N)",
        "plug", "actuator", "force", "limit", "left", "at y (mm)", right=range(2, 6),
    )  # fmt: skip
    for force in forces:
        left = f"{force.margin_n:.1f}"
        table.add_row(
            force.case,
            force.actuator,
            f"{force.force_n:.1f}",
            f"{force.limit_n:g}",
            left if force.margin_n >= 0 else f"[bold red]{left}[/]",
            "anywhere" if force.at_mm is None else f"{force.at_mm[1]:.1f}",
        )
    return table


def _lame(report: StudyReport) -> Table:
    table = plain_table(
        "The paper's Lame curve in place of the square (mm)",
        "", *LIMIT_TITLES, "largest side", "too large by", right=range(1, 7),
    )  # fmt: skip
    exact = report.lame[0].exact_side_mm
    margins = _strokes(report.regular_square.margins_mm)
    table.add_row("square, exact", *margins, f"{exact:.2f}", "")
    for curve in report.lame:
        table.add_row(
            f"n = {curve.exponent}",
            *_strokes(curve.margins_mm),
            f"{curve.largest_side_mm:.2f}",
            f"{curve.overstated_mm:.2f}",
        )
    return table


def _paper(report: StudyReport) -> Table:
    table = plain_table(
        "The paper's square about (570, 335) is inside exactly when (mm)",
        "x_c is the", "e1x <=", "e1x + s1 >=", "e2x <=", "e2x + s2 >=", "s1, s2 >=", "this robot",
        right=range(1, 6),
    )  # fmt: skip
    words = {True: "[green]meets it[/]", False: "does not", None: "is another one"}
    for reading in report.paper:
        table.add_row(
            reading.reading,
            f"{reading.e1x_max_mm:.2f}",
            f"{reading.e1x_plus_s1_min_mm:.2f}",
            f"{reading.e2x_max_mm:.2f}",
            f"{reading.e2x_plus_s2_min_mm:.2f}",
            f"{reading.s1_min_mm:.2f}",
            words[reading.met],
        )
    return table


def _print_requirements(console: Console, report: StudyReport) -> None:
    table = plain_table("Requirements of the paper", "", "requirement", "asked", "robot", "")
    for row in report.requirements:
        word, style = OUTCOME_STYLES[row.outcome]
        outcome = f"[{style}]{word}[/]"
        table.add_row(f"({row.key})", row.subject, row.required, row.figure, outcome)
    console.print(table)
    for row in report.requirements:
        console.print(f"[dim]({row.key}) {row.reason}[/]")


def _strokes(margins: StrokeMarginsMm) -> list[str]:
    values = [getattr(margins, name) for name in LIMITS]
    return [f"{v:.1f}" if v >= 0 else f"[bold red]{v:.1f}[/]" for v in values]


def _least(margins: StrokeMarginsMm) -> str:
    name = min(LIMITS, key=lambda limit: getattr(margins, limit))
    value = getattr(margins, name)
    word = "left" if value >= 0 else "missing"
    return f"{abs(value):.1f} {word} at {LIMIT_TITLES[LIMITS.index(name)]}"


def _point(point: Sequence[float]) -> str:
    return "(" + ", ".join(f"{value:.1f}" for value in point) + ")"
