"""A nine-point check as a PDF: what was found, place by place, in a table and in pictures.

It is drawn from what is kept of the check, and the same check gives the same bytes.
"""

from __future__ import annotations

import io

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from server.calibration.accuracy.verdict import REQUIRED_MM, judge_places
from server.calibration.grade import Grade
from server.schema.accuracy import AccuracyCheck, CheckedPlace
from server.schema.calibrations import Calibration

A4_INCH = (8.27, 11.69)
INK, SOFT, BELOW, ABOVE = "#1c2733", "#6b7785", "#1f6feb", "#d9480f"
MAGNIFIED = 200
"""So many times larger than the way between places their errors are drawn."""
_COLUMNS = ("Place", "x mm", "y mm", "AP mm", "RP mm", "vAP mm", "Approaches")


def accuracy_report(check: AccuracyCheck, calibration: Calibration | None) -> bytes:
    """The report of a check.

    Args:
        check: What was found.
        calibration: Of the robot, in force then; None: as drawn.
    """
    figure = Figure(figsize=A4_INCH)
    _write_head(figure, check, calibration)
    _draw_places(figure.add_axes((0.09, 0.41, 0.42, 0.28)), check.places)
    _draw_scatter(figure.add_axes((0.60, 0.41, 0.33, 0.28)), check.places)
    _draw_bars(figure.add_axes((0.09, 0.07, 0.84, 0.10)), check.places)
    _write_table(figure.add_axes((0.09, 0.21, 0.84, 0.155)), check.places)
    paper = io.BytesIO()
    with rc_context({"pdf.fonttype": 42, "font.family": "DejaVu Sans"}):
        figure.savefig(
            paper,
            format="pdf",
            metadata={"Title": f"Nine-point check {check.id}", "CreationDate": None},
        )
    return paper.getvalue()


def _write_head(figure: Figure, check: AccuracyCheck, calibration: Calibration | None) -> None:
    figure.text(0.09, 0.945, "PlugPilot", fontsize=15, weight="bold", color=INK)
    figure.text(0.09, 0.918, "Nine-point check, in the terms of ISO 9283", fontsize=12, color=INK)
    robot = (
        f"calibration {calibration.version} of {calibration.made_at:%d.%m.%Y}, by "
        f"{calibration.made_by}"
        if calibration
        else "as drawn, not calibrated"
    )
    lines = (
        f"Made on {check.made_at:%d.%m.%Y at %H:%M} UTC by {check.made_by}, "
        f"in {check.duration_s:.0f} s of robot time.",
        f"Robot: {robot}.",
        f"{len(check.places)} places, each {check.approaches} times from below and from above"
        + (f"; {check.left_out} without the label were left out." if check.left_out else "."),
    )
    for number, line in enumerate(lines):
        figure.text(0.09, 0.892 - 0.018 * number, line, fontsize=8.5, color=SOFT, parse_math=False)
    for number, (name, meaning, value_mm) in enumerate(
        (
            ("AP", "how far the mean is off", check.accuracy_mm),
            ("RP", "how well it repeats", check.repeatability_mm),
            ("vAP", "between both directions", check.direction_variation_mm),
        )
    ):
        left = 0.09 + 0.28 * number
        figure.text(left, 0.785, f"{value_mm:.3f} mm", fontsize=17, weight="bold", color=INK)
        figure.text(left, 0.767, f"largest {name}: {meaning}", fontsize=8, color=SOFT)
    good = judge_places(check.places)[0] is Grade.GOOD
    verdict = "is within" if good else "is NOT within"
    figure.text(
        0.09,
        0.728,
        f"AP + RP {verdict} the {REQUIRED_MM:g} mm that the robot's design asks for. Measured with "
        "the robot's own camera: where the label\nis, and how the camera is turned, is fitted. A "
        "label whose size is wrong by 0.1 % shows as 0.14 mm of AP at the corners.",
        fontsize=7.5,
        color=INK if good else ABOVE,
    )


def _draw_places(axes: Axes, places: list[CheckedPlace]) -> None:
    """Where the means are beside the places, much magnified."""
    _plain(axes, f"Mean of each place, {MAGNIFIED} times as far off", "x [mm]", "y [mm]")
    for number, place in enumerate(places, start=1):
        mean = np.mean(place.attained_mm, axis=0)
        off = MAGNIFIED * (mean - (place.x_mm, place.y_mm))
        axes.plot(place.x_mm, place.y_mm, "o", color=SOFT, markersize=4)
        axes.annotate(
            "",
            xy=(place.x_mm + off[0], place.y_mm + off[1]),
            xytext=(place.x_mm, place.y_mm),
            arrowprops={"arrowstyle": "->", "color": ABOVE, "linewidth": 1.2},
        )
        axes.annotate(
            str(number), (place.x_mm, place.y_mm), textcoords="offset points", xytext=(4, 4),
            fontsize=7, color=SOFT,
        )  # fmt: skip
    axes.margins(0.25)
    axes.set_aspect("equal", adjustable="datalim")


def _draw_scatter(axes: Axes, places: list[CheckedPlace]) -> None:
    """All approaches of all places about their commands."""
    _plain(axes, "All approaches", "x off [mm]", "y off [mm]")
    for number, place in enumerate(places):
        off = np.array(place.attained_mm) - (place.x_mm, place.y_mm)
        half = len(off) // 2
        for rows, colour, name in (
            (off[:half], BELOW, "below"),
            (off[half:], ABOVE, "above"),
        ):
            axes.plot(
                rows[:, 0], rows[:, 1], ".", color=colour, markersize=4,
                label=name if number == 0 else None,
            )  # fmt: skip
    axes.axhline(0.0, color=SOFT, linewidth=0.5)
    axes.axvline(0.0, color=SOFT, linewidth=0.5)
    axes.set_aspect("equal", adjustable="datalim")
    axes.legend(fontsize=7, frameon=False, ncols=2, loc="lower right", bbox_to_anchor=(1.0, 1.0))


def _draw_bars(axes: Axes, places: list[CheckedPlace]) -> None:
    _plain(axes, "AP and RP of each place", "", "mm")
    at = np.arange(1, len(places) + 1)
    axes.bar(at - 0.18, [one.accuracy_mm for one in places], 0.34, color=BELOW, label="AP")
    axes.bar(at + 0.18, [one.repeatability_mm for one in places], 0.34, color=ABOVE, label="RP")
    axes.set_xticks(at)
    axes.legend(fontsize=7, frameon=False, ncols=2, loc="lower right", bbox_to_anchor=(1.0, 1.0))


def _write_table(axes: Axes, places: list[CheckedPlace]) -> None:
    axes.set_axis_off()
    rows = [
        [
            str(number),
            f"{place.x_mm:.1f}",
            f"{place.y_mm:.1f}",
            f"{place.accuracy_mm:.3f}",
            f"{place.repeatability_mm:.3f}",
            f"{place.direction_variation_mm:.3f}",
            str(len(place.attained_mm)),
        ]
        for number, place in enumerate(places, start=1)
    ]
    table = axes.table(cellText=rows, colLabels=_COLUMNS, loc="center", cellLoc="right")
    table.auto_set_font_size(False)
    table.set_fontsize(8)
    for (row, _), cell in table.get_celld().items():
        cell.set_linewidth(0.3)
        cell.set_edgecolor("#d5dbe1")
        cell.set_text_props(color=INK, weight="bold" if row == 0 else "normal")


def _plain(axes: Axes, title: str, x: str, y: str) -> None:
    axes.set_title(title, fontsize=9, color=INK, loc="left")
    axes.set_xlabel(x, fontsize=7.5, color=SOFT)
    axes.set_ylabel(y, fontsize=7.5, color=SOFT)
    axes.tick_params(labelsize=7, colors=SOFT)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
