"""Random robots with finite travels, and the plain scan that the exact answers are checked by."""

from __future__ import annotations

import numpy as np
from hypothesis import reject
from hypothesis import strategies as st
from numpy.typing import NDArray
from pydantic import ValidationError

from tests.twin.strategies import between
from twin.geometry import JointRange, RobotGeometry
from twin.kinematics import alpha
from twin.workspace import ArcPolygon, EmptyWorkspaceError, reachable_region

Array = NDArray[np.float64]

DEFAULT = RobotGeometry()
LONG_STROKES = RobotGeometry(
    rho1=JointRange(min_mm=0, max_mm=700), rho2=JointRange(min_mm=0, max_mm=700)
)
UNEVEN = RobotGeometry(e1y_mm=140, e2y_mm=-60, rho1=JointRange(min_mm=30, max_mm=390))
"""Carriages at different heights, and a travel that does not start at 0."""

NEAR_MM = 1e-6
"""Points nearer than this to a limit may be decided by rounding."""


@st.composite
def robots(draw: st.DrawFn) -> RobotGeometry:
    """Any robot that reaches something: any offsets, short and long travels, uneven carriages."""
    start1, start2 = draw(between(-100, 300)), draw(between(-100, 300))
    try:
        geometry = RobotGeometry(
            leg_length_mm=draw(between(300, 900)),
            base_width_mm=draw(between(700, 2000)),
            platform_width_mm=draw(between(50, 300)),
            e1x_mm=draw(between(-80, 80)),
            e1y_mm=draw(st.one_of(st.just(0.0), between(-250, 250))),
            e2x_mm=draw(between(-80, 80)),
            e2y_mm=draw(st.one_of(st.just(0.0), between(-250, 250))),
            e_py_mm=draw(between(-120, 120)),
            theta_rad=draw(between(-0.6, 0.6)),
            rho1=JointRange(min_mm=start1, max_mm=start1 + draw(between(50, 1200))),
            rho2=JointRange(min_mm=start2, max_mm=start2 + draw(between(50, 1200))),
        )
        extent = reachable_region(geometry).extent
    except (ValidationError, EmptyWorkspaceError):
        reject()
    # thinner regions are all rounding
    if min(extent.x_max_mm - extent.x_min_mm, extent.y_max_mm - extent.y_min_mm) < 1:
        reject()
    return geometry


def stroke_left(geometry: RobotGeometry, points_mm: Array) -> Array:
    """Distance of both joints from the ends of their travels, shape (...); -inf out of reach."""
    rho = alpha.inverse_many(geometry, points_mm)
    low = np.array([geometry.rho1.min_mm, geometry.rho2.min_mm])
    high = np.array([geometry.rho1.max_mm, geometry.rho2.max_mm])
    left = np.minimum(rho - low, high - rho).min(axis=-1)
    return np.where(np.isnan(left), -np.inf, left)


def grid_over(region: ArcPolygon, count: int, beyond: float = 0.05) -> tuple[Array, float]:
    """A grid of count x count points around a region, shape (count, count, 2), and its cell area.

    Points lie in the middles of the cells.
    """
    x_min, x_max, y_min, y_max = region.extent
    width, height = (x_max - x_min) * (1 + 2 * beyond), (y_max - y_min) * (1 + 2 * beyond)
    share = (np.arange(count) + 0.5) / count
    x = x_min - beyond * (x_max - x_min) + width * share
    y = y_min - beyond * (y_max - y_min) + height * share
    return np.stack(np.meshgrid(x, y), axis=-1), width * height / count**2


def points_in(rectangle: tuple[float, float, float, float], count: int) -> Array:
    """count x count points of a rectangle (x_min, x_max, y_min, y_max), edges included."""
    x_min, x_max, y_min, y_max = rectangle
    x, y = np.linspace(x_min, x_max, count), np.linspace(y_min, y_max, count)
    return np.stack(np.meshgrid(x, y), axis=-1)
