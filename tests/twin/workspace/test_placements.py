from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.twin.strategies import between
from tests.twin.workspace.robots import (
    DEFAULT,
    LONG_STROKES,
    NEAR_MM,
    UNEVEN,
    Array,
    grid_over,
    points_in,
    robots,
    stroke_left,
)
from twin.geometry import RobotGeometry
from twin.kinematics import SingularityLimits, alpha
from twin.workspace import (
    InvalidRectangleError,
    Point,
    Rectangle,
    fits,
    placement_region,
    reachable_region,
    stroke_margins,
)


def around(center: Array, width_mm: float, height_mm: float) -> Rectangle:
    x_mm, y_mm = center.tolist()
    return Rectangle(x_mm, y_mm, width_mm, height_mm)


def fits_by_sampling(geometry: RobotGeometry, rectangle: Rectangle, count: int = 41) -> bool:
    """Whether a grid of positions of the rectangle, edges included, is reached."""
    edges = (rectangle.x_min_mm, rectangle.x_max_mm, rectangle.y_min_mm, rectangle.y_max_mm)
    return bool((stroke_left(geometry, points_in(edges, count)) >= -NEAR_MM).all())


def assert_agrees_with_sampled_rectangles(
    geometry: RobotGeometry, width_mm: float, height_mm: float, count: int
) -> None:
    """A centre belongs to the region exactly when all of its rectangle is reached."""
    region = placement_region(geometry, width_mm, height_mm)
    centers, _ = grid_over(reachable_region(geometry) if region.is_empty else region, count, 0.2)
    for center, found in zip(
        centers.reshape(-1, 2), region.contains_many(centers).ravel(), strict=True
    ):
        rectangle = around(center, width_mm, height_mm)
        if found:
            assert fits_by_sampling(geometry, rectangle)
        elif fits_by_sampling(geometry, rectangle):
            # only what lies between two samples of an edge may have been missed
            missed = stroke_margins(geometry, rectangle).smallest.value_mm
            assert -missed < height_mm / 40
            assert missed < NEAR_MM


@pytest.mark.parametrize(
    ("geometry", "width_mm", "height_mm"),
    [
        (DEFAULT, 200, 200),
        (DEFAULT, 50, 300),
        (DEFAULT, 300, 40),
        (LONG_STROKES, 200, 200),
        (LONG_STROKES, 500, 120),
        (UNEVEN, 60, 90),
        (DEFAULT, 300, 300),
    ],
)
def test_the_centres_are_those_whose_rectangle_is_reached(
    geometry: RobotGeometry, width_mm: float, height_mm: float
) -> None:
    assert_agrees_with_sampled_rectangles(geometry, width_mm, height_mm, 25)


@settings(max_examples=40)
@given(robots(), between(0.05, 0.7), between(0.05, 0.7))
def test_so_they_are_for_any_robot(
    geometry: RobotGeometry, width_share: float, height_share: float
) -> None:
    extent = reachable_region(geometry).extent
    width_mm = width_share * (extent.x_max_mm - extent.x_min_mm)
    height_mm = height_share * (extent.y_max_mm - extent.y_min_mm)
    assert_agrees_with_sampled_rectangles(geometry, width_mm, height_mm, 7)


@settings(max_examples=60)
@given(robots(), between(0.01, 0.7), between(0.01, 0.7))
def test_the_region_is_one_loop_inside_the_reachable_one(
    geometry: RobotGeometry, width_share: float, height_share: float
) -> None:
    whole = reachable_region(geometry)
    extent = whole.extent
    width_mm = width_share * (extent.x_max_mm - extent.x_min_mm)
    height_mm = height_share * (extent.y_max_mm - extent.y_min_mm)
    region = placement_region(geometry, width_mm, height_mm)
    assume(not region.is_empty)
    assert len(region.loops) == 1
    assert 0 < region.area_mm2 < whole.area_mm2
    for center in np.concatenate([piece.points(5) for piece in region.pieces]):
        rectangle = around(center, width_mm, height_mm)
        margins = stroke_margins(geometry, rectangle)
        assert margins.smallest.value_mm == pytest.approx(0, abs=1e-4)
        assert whole.contains_many(np.array([*around(center, 0.5 * width_mm, 1e-3).corners])).all()


@settings(max_examples=60)
@given(robots(), st.data())
def test_a_rectangle_fits_where_the_region_says_so(
    geometry: RobotGeometry, data: st.DataObject
) -> None:
    x_min, x_max, y_min, y_max = reachable_region(geometry).extent
    rectangle = Rectangle(
        data.draw(between(x_min, x_max)),
        data.draw(between(y_min, y_max)),
        data.draw(between(0.01, 0.5)) * (x_max - x_min),
        data.draw(between(0.01, 0.5)) * (y_max - y_min),
    )
    assume(abs(stroke_margins(geometry, rectangle).smallest.value_mm) > NEAR_MM)
    region = placement_region(geometry, rectangle.width_mm, rectangle.height_mm)
    found = region.contains(rectangle.center_x_mm, rectangle.center_y_mm)
    assert found is fits(geometry, rectangle)


def test_the_centres_of_the_paper_s_square() -> None:
    """Four arcs about the shifted circle centres; vertices worked out by hand."""
    region = placement_region(DEFAULT, 200, 200)
    assert len(region.pieces) == 4
    x_min, x_max, y_min, y_max = region.extent
    # rho1 and rho2 at their starts in the lower corners, at their ends in the upper ones
    assert y_min == pytest.approx(100 + math.sqrt(532**2 - (595 - 100) ** 2))
    assert y_max == pytest.approx(-100 + math.sqrt(532**2 - (175 + 100) ** 2))
    assert x_min + x_max == pytest.approx(1300)
    assert region.contains(650, 335)
    # farthest right the lower right corner starts rho2 and the upper right one ends rho1
    corner = region.vertices[1]
    assert corner.x_mm == pytest.approx(x_max)
    reaches = [math.sqrt(532**2 - (corner.y_mm + away) ** 2) for away in (-100, 100)]
    assert sum(reaches) == pytest.approx(1190 - 420)


def test_small_rectangles_may_stand_nearly_anywhere() -> None:
    whole = reachable_region(DEFAULT)
    nearly = placement_region(DEFAULT, 1e-6, 1e-6)
    assert nearly.area_mm2 == pytest.approx(whole.area_mm2, rel=1e-7)


def test_the_edge_may_touch_where_no_corner_does() -> None:
    """With the left carriage high up, its circle's widest point touches the edge's middle."""
    rectangle = Rectangle(700, 140, 60, 90)
    margin = stroke_margins(UNEVEN, rectangle).rho1_min
    assert margin.at == Point(670, 140)
    touching = Rectangle(700 - margin.value_mm, 140, 60, 90)
    assert stroke_margins(UNEVEN, touching).rho1_min.value_mm == pytest.approx(0)
    corners = np.array(touching.corners)
    assert alpha.inverse_many(UNEVEN, corners)[:, 0].min() > UNEVEN.rho1.min_mm + 1


def test_with_limits_of_singularity() -> None:
    limits = SingularityLimits(parallel=0.8)
    region = placement_region(DEFAULT, 150, 100, limits)
    x_min, _, y_min, _ = region.extent
    assert x_min > 440
    # sin(2 phi) = 0.8 at the lower edge of the lowest rectangle
    lowest = 532 * math.sin(0.5 * math.asin(0.8))
    assert y_min == pytest.approx(lowest + 50)
    assert placement_region(DEFAULT, 150, 100).extent.y_min_mm < y_min


@pytest.mark.parametrize("size", [0, -1, math.nan, math.inf])
def test_sizes_that_make_no_rectangle(size: float) -> None:
    with pytest.raises(InvalidRectangleError, match="cannot have a height of"):
        placement_region(DEFAULT, 100, size)
    with pytest.raises(InvalidRectangleError, match="cannot have a width of") as caught:
        Rectangle(650, 335, size, 100)
    assert caught.value.code == "invalid_rectangle"


@pytest.mark.parametrize("place", [math.nan, math.inf])
def test_places_that_make_no_rectangle(place: float) -> None:
    with pytest.raises(InvalidRectangleError, match="no centre"):
        Rectangle(650, place, 100, 100)
