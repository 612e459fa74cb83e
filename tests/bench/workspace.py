"""How fast the exact workspace is, beside the plain scan that it replaces.

Run with: python -m tests.bench.workspace
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable

import numpy as np

from twin.geometry import RobotGeometry
from twin.kinematics import alpha
from twin.workspace import (
    Measure,
    Rectangle,
    compare_with_lame,
    largest_rectangle,
    map_axes,
    placement_region,
    reachable_region,
    stroke_margins,
    workspace_maps,
    worst_over,
)

REPEATS = 31
SCAN_STEP_MM = 2.0
SAMPLES_PER_EDGE = 11
GEOMETRY = RobotGeometry()
REGULAR = Rectangle.of_box(GEOMETRY.regular_box)


def timed_ms(call: Callable[[], object], repeats: int = REPEATS) -> tuple[float, float]:
    """Median and 95th percentile of one call [ms]."""
    call()
    times: list[float] = []
    for _ in range(repeats):
        began = time.perf_counter()
        call()
        times.append((time.perf_counter() - began) * 1e3)
    return statistics.median(times), statistics.quantiles(times, n=20)[-1]


def scanned_area_mm2(width_mm: float, height_mm: float) -> float:
    """Area of the centres on a grid whose sampled rectangle is reached; 0 sizes for points."""
    extent = reachable_region(GEOMETRY).extent
    x = np.arange(extent.x_min_mm, extent.x_max_mm, SCAN_STEP_MM)
    y = np.arange(extent.y_min_mm, extent.y_max_mm, SCAN_STEP_MM)
    centers = np.stack(np.meshgrid(x, y), axis=-1)
    reached = np.ones(centers.shape[:2], dtype=np.bool_)
    shares = np.linspace(-0.5, 0.5, SAMPLES_PER_EDGE if width_mm > 0 else 1)
    for across in shares * width_mm:
        for up in shares * height_mm:
            rho = alpha.inverse_many(GEOMETRY, centers + np.array([across, up]))
            reached &= ((rho >= 0) & (rho <= GEOMETRY.rho1.max_mm)).all(axis=-1)
    return float(reached.sum()) * SCAN_STEP_MM**2


def print_regions() -> None:
    """Exact regions beside the scan."""
    width_mm, height_mm = REGULAR.width_mm, REGULAR.height_mm
    rows: list[tuple[str, Callable[[], float], Callable[[], float]]] = [
        (
            "reachable region",
            lambda: reachable_region(GEOMETRY).area_mm2,
            lambda: scanned_area_mm2(0, 0),
        ),
        (
            "placements of the square",
            lambda: placement_region(GEOMETRY, width_mm, height_mm).area_mm2,
            lambda: scanned_area_mm2(width_mm, height_mm),
        ),
    ]
    print(f"Regions [ms]; scan on {SCAN_STEP_MM:g} mm, {SAMPLES_PER_EDGE} samples along an edge")
    print(f"{'':26}{'exact':>8}{'p95':>8}{'mm^2':>11}{'scan':>9}{'p95':>9}{'mm^2':>9}{'faster':>8}")
    for name, exact, scan in rows:
        median, p95 = timed_ms(exact)
        scan_median, scan_p95 = timed_ms(scan, 5)
        print(
            f"{name:26}{median:8.3f}{p95:8.3f}{exact():11.1f}"
            f"{scan_median:9.1f}{scan_p95:9.1f}{scan():9.0f}{scan_median / median:7.0f}x"
        )


def print_questions() -> None:
    """What else is asked of the workspace."""
    axes = map_axes(GEOMETRY, SCAN_STEP_MM)
    region = reachable_region(GEOMETRY)
    points = np.stack(np.meshgrid(*axes), axis=-1)
    rows: list[tuple[str, Callable[[], object]]] = [
        ("margins of the square", lambda: stroke_margins(GEOMETRY, REGULAR)),
        ("largest square", lambda: largest_rectangle(GEOMETRY)),
        ("Lame curves, n = 6 and 12", lambda: compare_with_lame(GEOMETRY, 650, 335, 100)),
        ("worst condition number", lambda: worst_over(GEOMETRY, REGULAR, Measure.CONDITION)),
        (f"membership of {points[..., 0].size} points", lambda: region.contains_many(points)),
        (
            f"map of {points[..., 0].size} points",
            lambda: workspace_maps(GEOMETRY, *axes).of(Measure.CONDITION),
        ),
    ]
    print(f"\nQuestions [ms], {REPEATS} repeats\n{'':30}{'median':>9}{'p95':>9}")
    for name, call in rows:
        median, p95 = timed_ms(call)
        print(f"{name:30}{median:9.3f}{p95:9.3f}")


if __name__ == "__main__":
    print_regions()
    print_questions()
