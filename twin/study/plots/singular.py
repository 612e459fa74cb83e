"""The robot in its singular postures."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from twin.geometry import RobotGeometry
from twin.kinematics import alpha
from twin.kinematics.alpha import LegVectors, PlatformPosition
from twin.study.plots.robot import draw_rail, draw_robot
from twin.study.plots.style import SQUARE, legend_below, new_figure, wall_axes
from twin.study.plots.workspace import draw_arcs, fill_region
from twin.workspace import Measure, measure_rows, reachable_region


@dataclass(frozen=True, slots=True)
class Posture:
    """A posture with the sentence that belongs to it."""

    title: str
    v: PlatformPosition
    legs: LegVectors
    remark: str


def singular_postures(geometry: RobotGeometry) -> tuple[Posture, ...]:
    """The postures of the three kinds of singularity, as far within the strokes as can be."""
    upright_y = min(geometry.e1y_mm, geometry.e2y_mm) + geometry.leg_length_mm
    folded_y = _folded_height(geometry)
    flattest_y, flattest = _flattest_parallelogram(geometry)
    kind = "no flat one exists; the flattest" if flattest > 1e-9 else "flat"
    return (
        _posture(geometry, "(a) Parallel: legs in line", folded_y),
        _posture(geometry, "(b) Serial: leg perpendicular to the rail", upright_y),
        _posture(
            geometry,
            f"(c) Parallelogram: {kind}",
            flattest_y,
            f"Sine of its angle {flattest:.3f} at y = {flattest_y:.0f} mm. ",
        ),
    )


def draw_singular(geometry: RobotGeometry) -> Figure:
    """The figure: one posture in each panel, over the workspace."""
    postures = singular_postures(geometry)
    figure = new_figure(205.0, 120.0)
    panels = figure.subplots(len(postures), 1, sharex=True)
    region = reachable_region(geometry)
    for number, (axes, posture) in enumerate(zip(panels, postures, strict=True)):
        _panel(axes, geometry, posture)
        fill_region(axes, region)
        draw_arcs(axes, region, named=number == 0)
        low_mm = min(geometry.e1y_mm + min(geometry.e_py_mm, 0.0), geometry.e2y_mm)
        high_mm = max(geometry.e1y_mm, geometry.e2y_mm) + geometry.leg_length_mm
        axes.set_ylim(low_mm - 90, high_mm + 40)
    for axes in panels[:-1]:
        axes.set_xlabel("")
    legend_below(figure, columns=2)
    return figure


def _panel(axes: Axes, geometry: RobotGeometry, posture: Posture) -> None:
    wall_axes(axes, posture.title)
    draw_rail(axes, geometry)
    draw_robot(axes, geometry, posture.v, posture.legs)
    axes.plot(*posture.v, marker="o", markersize=5, color=SQUARE, zorder=8)
    axes.text(
        0.985, 0.03, posture.remark, transform=axes.transAxes, ha="right", va="bottom", fontsize=8
    )


def _posture(geometry: RobotGeometry, title: str, y_mm: float, remark: str = "") -> Posture:
    """The posture with V at a height, as far from the ends of both strokes as can be."""
    d1, d2 = (
        math.sqrt(max(geometry.leg_length_mm**2 - (y_mm - foot) ** 2, 0.0))
        for foot in (geometry.e1y_mm, geometry.e2y_mm)
    )
    left_mm, right_mm = alpha.feet_mm(geometry, 0.0, 0.0)
    # rho1 = x - left - d1 and rho2 = right - x - d2, so at one height their sum is given
    rho_sum = right_mm - left_mm - d1 - d2
    # the middle of what both strokes leave, or of the gap where they leave nothing
    low = max(geometry.rho1.min_mm, rho_sum - geometry.rho2.max_mm)
    high = min(geometry.rho1.max_mm, rho_sum - geometry.rho2.min_mm)
    rho1 = 0.5 * (low + high)
    rho2 = rho_sum - rho1
    excess = max(abs(geometry.rho1.excess_mm(rho1)), abs(geometry.rho2.excess_mm(rho2)))
    within = "Within the strokes." if excess < 1e-6 else f"{excess:.0f} mm beyond the strokes."
    v = PlatformPosition(left_mm + rho1 + d1, y_mm)
    return Posture(title, v, alpha.leg_vectors(geometry, v, rho1, rho2), remark + within)


def _folded_height(geometry: RobotGeometry) -> float:
    """Height of V with both legs in one line: half way between the carriages."""
    return 0.5 * (geometry.e1y_mm + geometry.e2y_mm)


def _flattest_parallelogram(geometry: RobotGeometry) -> tuple[float, float]:
    """Height of V where the parallelogram is flattest, and the sine of its angle there.

    That sine is sin(phi - atan(e_py / (L3/2))) without its sign, with phi the angle of the left
    leg: it is least where it vanishes, or else at one end of the heights.
    """
    half_mm, e_py_mm = 0.5 * geometry.platform_width_mm, geometry.e_py_mm
    bar_mm = math.hypot(half_mm, e_py_mm)
    low_mm = max(geometry.e1y_mm, geometry.e2y_mm)
    high_mm = min(geometry.e1y_mm, geometry.e2y_mm) + geometry.leg_length_mm
    flat_mm = geometry.e1y_mm + geometry.leg_length_mm * e_py_mm / bar_mm
    y_mm = np.array([low_mm, high_mm, min(max(flat_mm, low_mm), high_mm)])
    area = measure_rows(geometry, Measure.PARALLELOGRAM_AREA, y_mm)
    row = int(np.nanargmin(area))
    return float(y_mm[row]), float(area[row]) / (geometry.leg_length_mm * bar_mm)
