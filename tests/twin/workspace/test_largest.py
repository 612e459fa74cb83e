from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings

from tests.twin.strategies import between
from tests.twin.workspace.robots import (
    DEFAULT,
    LONG_STROKES,
    UNEVEN,
    grid_over,
    points_in,
    robots,
    stroke_left,
)
from twin.geometry import JointRange, RobotGeometry
from twin.workspace import (
    InvalidRectangleError,
    Limit,
    Rectangle,
    RectangleOutsideError,
    fits,
    largest_rectangle,
    largest_rectangle_at,
    placement_region,
    reachable_region,
)


def scanned_height(geometry: RobotGeometry, aspect: float, count: int, samples: int) -> float:
    """The best of a grid of centres, each with its height found by bisection over samples."""
    centers = grid_over(reachable_region(geometry), count, 0)[0].reshape(-1, 1, 1, 2)
    offsets = points_in((-0.5 * aspect, 0.5 * aspect, -0.5, 0.5), samples)
    low, high = np.zeros(len(centers)), np.full(len(centers), 4000.0)
    for _ in range(30):
        middle = 0.5 * (low + high)
        points = centers + offsets * middle[:, None, None, None]
        held = (stroke_left(geometry, points) >= 0).all(axis=(1, 2))
        low, high = np.where(held, middle, low), np.where(held, high, middle)
    return float(low.max())


@pytest.mark.parametrize(
    ("geometry", "aspect"),
    [(DEFAULT, 1.0), (DEFAULT, 3.0), (DEFAULT, 0.3), (LONG_STROKES, 1.0), (UNEVEN, 1.0)],
)
def test_no_scanned_rectangle_is_larger_and_the_best_is_nearly_as_large(
    geometry: RobotGeometry, aspect: float
) -> None:
    count, samples = 41, 13
    largest = largest_rectangle(geometry, aspect)
    scanned = scanned_height(geometry, aspect, count, samples)
    extent = reachable_region(geometry).extent
    step = max(extent.x_max_mm - extent.x_min_mm, extent.y_max_mm - extent.y_min_mm) / count
    assert scanned <= largest.rectangle.height_mm + 0.1  # an edge between samples may stick out
    assert scanned >= largest.rectangle.height_mm - 2 * step * max(1, 1 / aspect)


@settings(max_examples=40)
@given(robots(), between(0.2, 5))
def test_it_fits_and_nothing_larger_does(geometry: RobotGeometry, aspect: float) -> None:
    found = largest_rectangle(geometry, aspect)
    rectangle = found.rectangle
    assert rectangle.width_mm == pytest.approx(aspect * rectangle.height_mm)
    assert fits(geometry, rectangle)
    larger = rectangle.height_mm + 1e-6
    assert placement_region(geometry, aspect * larger, larger).is_empty
    # something holds it from two sides at least
    assert len(found.contacts) >= 2


def test_the_default_square() -> None:
    """By symmetry at x = 650: both lower corners at the starts, both upper ones at the ends."""
    found = largest_rectangle(DEFAULT)
    half = 0.5 * found.rectangle.width_mm
    assert found.rectangle.center_x_mm == pytest.approx(650, abs=1e-8)
    bottom = math.sqrt(532**2 - (595 - half) ** 2)
    top = math.sqrt(532**2 - (175 + half) ** 2)
    assert top - bottom == pytest.approx(2 * half, abs=1e-8)
    assert found.rectangle.center_y_mm == pytest.approx(0.5 * (top + bottom), abs=1e-8)
    assert found.rectangle.width_mm == pytest.approx(224.3879238844, abs=1e-8)
    assert found.contacts == (Limit.RHO1_MIN, Limit.RHO1_MAX, Limit.RHO2_MIN, Limit.RHO2_MAX)
    assert max(found.free_x_mm, found.free_y_mm) < 1e-6


def test_it_may_sit_in_many_places() -> None:
    """A narrow and tall one is held by the legs' height alone and may be shifted along the rail."""
    found = largest_rectangle(LONG_STROKES, 0.01)
    assert found.contacts == (Limit.ASSEMBLY_SIDE, Limit.LEG_LENGTH)
    assert found.rectangle.height_mm == pytest.approx(532, abs=1e-8)
    assert found.free_x_mm > 50
    assert found.rectangle.center_x_mm == pytest.approx(650)


def test_it_may_sit_in_a_round_corner() -> None:
    """At the right carriage's own height the flattest part of its two circles leaves most room."""
    geometry = RobotGeometry(
        leg_length_mm=300,
        base_width_mm=700,
        platform_width_mm=50,
        e1x_mm=0,
        e2x_mm=0,
        e2y_mm=10,
        rho1=JointRange(min_mm=0, max_mm=51),
        rho2=JointRange(min_mm=0, max_mm=50),
    )
    found = largest_rectangle(geometry, 5)
    assert found.contacts == (Limit.RHO2_MIN, Limit.RHO2_MAX)
    assert found.rectangle.center_y_mm == pytest.approx(10, abs=1e-2)
    half = 0.5 * found.rectangle.height_mm
    spent = 10 * half + 300 - math.sqrt(300**2 - half**2)
    assert spent == pytest.approx(50, abs=1e-8)


def test_about_a_given_centre() -> None:
    found = largest_rectangle_at(DEFAULT, 650, 335)
    assert found.rectangle.width_mm == pytest.approx(223.99150146888, abs=1e-8)
    assert found.contacts == (Limit.RHO1_MIN, Limit.RHO2_MIN)
    assert fits(DEFAULT, found.rectangle)
    assert not fits(DEFAULT, Rectangle.square(650, 335, found.rectangle.width_mm + 1e-8))
    assert found.rectangle.width_mm <= largest_rectangle(DEFAULT).rectangle.width_mm


def test_the_overall_largest_is_the_largest_about_its_own_centre() -> None:
    best = largest_rectangle(UNEVEN, 2).rectangle
    again = largest_rectangle_at(UNEVEN, best.center_x_mm, best.center_y_mm, 2)
    assert again.rectangle.height_mm == pytest.approx(best.height_mm, abs=1e-7)


@pytest.mark.parametrize("center", [(650, -10), (100, 300), (650, 520)])
def test_a_centre_outside(center: tuple[float, float]) -> None:
    with pytest.raises(RectangleOutsideError, match="is not inside the workspace"):
        largest_rectangle_at(DEFAULT, *center)


@pytest.mark.parametrize("aspect", [0.0, -1.0, math.nan, math.inf])
def test_shapes_that_are_none(aspect: float) -> None:
    with pytest.raises(InvalidRectangleError, match="times its height"):
        largest_rectangle(DEFAULT, aspect)
    with pytest.raises(InvalidRectangleError):
        largest_rectangle_at(DEFAULT, 650, 335, aspect)
