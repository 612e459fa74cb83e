from __future__ import annotations

import math

import numpy as np
import pytest

from twin.workspace import Arc, ArcPolygon, EmptyRegionError, Limit, Point, Segment
from twin.workspace.boundary import Piece

LIMIT = Limit.RHO1_MIN


def disc(x: float, y: float, radius: float) -> tuple[Piece, ...]:
    low, high, center = Point(x, y - radius), Point(x, y + radius), Point(x, y)
    return (
        Arc(low, high, center, radius, 1, LIMIT),
        Arc(high, low, center, radius, -1, LIMIT),
    )


def half_moon() -> ArcPolygon:
    """The right half of a unit disc about (2, 3), closed by a vertical segment."""
    low, high = Point(2, 2), Point(2, 4)
    arc = Arc(low, high, Point(2, 3), 1, 1, LIMIT)
    return ArcPolygon(((arc, Segment(high, low, LIMIT)),))


def test_a_disc() -> None:
    polygon = ArcPolygon((disc(400, -300, 50),))
    assert polygon.area_mm2 == pytest.approx(math.pi * 2500, rel=1e-13)
    assert polygon.perimeter_mm == pytest.approx(math.pi * 100, rel=1e-13)
    assert polygon.extent == pytest.approx((350, 450, -350, -250))


def test_a_half_disc() -> None:
    polygon = half_moon()
    assert polygon.area_mm2 == pytest.approx(math.pi / 2)
    assert polygon.perimeter_mm == pytest.approx(math.pi + 2)
    assert polygon.extent == pytest.approx((2, 3, 2, 4))
    assert polygon.vertices == (Point(2, 2), Point(2, 4))


def test_a_region_outside_of_a_circle() -> None:
    """A square whose right side is pushed in by a circle: the arc runs clockwise."""
    a, b, c, d = Point(0, 0), Point(2, 0), Point(2, 2), Point(0, 2)
    bite = Arc(b, c, Point(2, 1), 1, -1, LIMIT)
    polygon = ArcPolygon(
        ((Segment(a, b, LIMIT), bite, Segment(c, d, LIMIT), Segment(d, a, LIMIT)),)
    )
    assert bite.end_rad < bite.start_rad
    assert polygon.area_mm2 == pytest.approx(4 - math.pi / 2)
    assert polygon.extent == pytest.approx((0, 2, 0, 2))
    assert not polygon.contains(1.5, 1)
    assert polygon.contains(0.9, 1)
    assert polygon.contains(1.3, 0.2)
    assert not polygon.contains(1.5, 0.2)


def test_several_loops() -> None:
    polygon = ArcPolygon((disc(0, 0, 1), disc(10, 5, 2)))
    assert polygon.area_mm2 == pytest.approx(math.pi * 5)
    assert polygon.contains(10, 6)
    assert polygon.contains(0, 0.5)
    assert not polygon.contains(5, 2.5)


def test_points_at_the_height_of_a_vertex() -> None:
    polygon = half_moon()
    for y in (2.0, 4.0, 3.0):
        assert not polygon.contains(0, y), y
        assert not polygon.contains(5, y), y
    assert polygon.contains(2.5, 3.0)


def test_points_in_the_disc_and_around_it() -> None:
    rng = np.random.default_rng(0)
    points = rng.uniform(-2, 2, (4000, 2))
    found = ArcPolygon((disc(0, 0, 1),)).contains_many(points)
    np.testing.assert_array_equal(found, np.hypot(*points.T) < 1)


def test_nan_is_nowhere() -> None:
    assert not half_moon().contains(math.nan, 3)
    assert not half_moon().contains(2.5, math.nan)


def test_chord() -> None:
    assert half_moon().chord(3) == pytest.approx((2, 3))
    assert half_moon().chord(4) == pytest.approx((2, 2))
    assert half_moon().chord(4.1) is None


def test_the_line_for_drawing_is_as_near_as_it_says() -> None:
    sagitta = 0.05
    (line,) = ArcPolygon((disc(0, 0, 532),)).polylines(sagitta)
    np.testing.assert_array_equal(line[0], line[-1])
    np.testing.assert_allclose(np.hypot(*line.T), 532, rtol=1e-12)
    middles = np.hypot(*(0.5 * (line[1:] + line[:-1])).T)
    assert 532 - sagitta <= middles.min() <= 532 - 0.9 * sagitta
    assert 200 < len(line) < 300


def test_elsewhere() -> None:
    moved = half_moon().translated(10, -20)
    assert moved.extent == pytest.approx((12, 13, -18, -16))
    assert moved.area_mm2 == pytest.approx(half_moon().area_mm2)
    assert moved.contains(12.5, -17)


def test_nothing() -> None:
    nothing = ArcPolygon(())
    assert nothing.is_empty
    assert nothing.area_mm2 == 0
    assert nothing.polylines() == []
    assert not nothing.contains(0, 0)
    with pytest.raises(EmptyRegionError) as caught:
        _ = nothing.extent
    assert caught.value.code == "empty_region"
