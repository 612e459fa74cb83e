"""The robot in one posture, as a line drawing in the wall plane."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.patches import FancyBboxPatch, Polygon

from twin.geometry import RobotGeometry
from twin.kinematics.alpha import LegVectors, PlatformPosition
from twin.study.plots.style import GREY, HALO, ROBOT

CARRIAGE_WIDTH_MM = 46.0
CARRIAGE_HEIGHT_MM = 26.0
"""Of the symbol, not of a part."""

PIVOT_NAME_OFFSETS = {
    "A": (-9, 8), "B": (-3, 6), "C": (-3, 6), "D": (5, -4), "E": (3, 8), "F": (5, -9), "V": (-3, 6),
}  # fmt: skip
"""From a joint to its letter [points]."""


def draw_rail(axes: Axes, geometry: RobotGeometry) -> None:
    """The rail, or one for each carriage if they run at different heights."""
    left = min(0.0, geometry.e1x_mm)
    right = geometry.base_width_mm + max(0.0, -geometry.e2x_mm)
    for y_mm in {geometry.e1y_mm, geometry.e2y_mm}:
        axes.plot([left, right], [y_mm, y_mm], color=GREY, linewidth=2.2, zorder=2)


def draw_robot(
    axes: Axes,
    geometry: RobotGeometry,
    v: PlatformPosition,
    legs: LegVectors,
    *,
    colour: str = ROBOT,
    pivots: bool = False,
    strength: float = 1.0,
) -> None:
    """Legs, parallelogram, platform and carriages.

    Args:
        axes: Where to draw.
        geometry: The robot.
        v: Midpoint of the platform.
        legs: Its legs there.
        colour: Of the lines.
        pivots: Write the names of the joints beside them.
        strength: Opacity.
    """
    half = 0.5 * geometry.platform_width_mm
    b, c = (v.x_mm - half, v.y_mm), (v.x_mm + half, v.y_mm)
    a = (b[0] - legs.d1_mm, b[1] - legs.h1_mm)
    e = (c[0] + legs.d2_mm, c[1] - legs.h2_mm)
    f = (v.x_mm, v.y_mm + geometry.e_py_mm)
    d = (a[0] + half, a[1] + geometry.e_py_mm)

    def bar(width: float, *ends: tuple[float, float]) -> None:
        axes.plot(
            *zip(*ends, strict=True),
            color=colour,
            alpha=strength,
            linewidth=width,
            solid_joinstyle="round",
            zorder=4,
        )

    bar(2.0, a, b)
    bar(2.0, e, c)
    bar(1.2, d, f)
    bar(3.2, b, c)
    bar(0.9, b, f, c)
    bar(0.9, a, d)
    axes.add_patch(Polygon([a, b, f, d], facecolor=colour, alpha=0.10 * strength, zorder=2))
    for foot in (a, e):
        axes.add_patch(
            FancyBboxPatch(
                (foot[0] - CARRIAGE_WIDTH_MM / 2, foot[1] - CARRIAGE_HEIGHT_MM / 2),
                CARRIAGE_WIDTH_MM,
                CARRIAGE_HEIGHT_MM,
                boxstyle="round,pad=0,rounding_size=6",
                facecolor="white",
                edgecolor=colour,
                linewidth=1.0,
                alpha=strength,
                zorder=3,
            )
        )
    joints = {"A": a, "B": b, "C": c, "E": e, "D": d, "F": f}
    axes.plot(
        *zip(*joints.values(), strict=True),
        linestyle="none",
        marker="o",
        markersize=3.4,
        markerfacecolor="white",
        markeredgecolor=colour,
        markeredgewidth=0.9,
        alpha=strength,
        zorder=5,
    )
    axes.plot(*v, marker="+", color=colour, markersize=6, alpha=strength, zorder=6)
    if pivots:
        for name, place in {**joints, "V": v}.items():
            axes.annotate(
                f"${name}$",
                place,
                PIVOT_NAME_OFFSETS[name],
                textcoords="offset points",
                fontsize=9,
                zorder=9,
                path_effects=HALO,
            )
