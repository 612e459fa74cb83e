from __future__ import annotations

import math

import pytest

from twin.workspace import Limit, Point, Segment
from twin.workspace.between import Band, region_between
from twin.workspace.flank import Flank, crossing_heights

RADIUS = 10.0
LEFT, RIGHT = Limit.RHO1_MIN, Limit.RHO1_MAX
BAND = Band(-10, 10, Limit.ASSEMBLY_SIDE, Limit.LEG_LENGTH)


def half_circle(x: float, y: float, side: int, limit: Limit) -> Flank:
    return Flank(Point(x, y), RADIUS, side, y - RADIUS, y + RADIUS, limit)


def line(x: float, limit: Limit) -> Flank:
    return Flank(Point(x, 0), RADIUS, 0, -100, 100, limit)


def lens_area(distance: float) -> float:
    """Area that two discs of RADIUS at a distance have in common."""
    half = math.acos(distance / (2 * RADIUS))
    return RADIUS**2 * (2 * half - math.sin(2 * half))


def test_a_lens_of_two_discs() -> None:
    lens = region_between([half_circle(6, 0, -1, LEFT)], [half_circle(-6, 0, 1, RIGHT)], [BAND])
    assert lens.area_mm2 == pytest.approx(lens_area(12), rel=1e-13)
    assert [piece.limit for piece in lens.pieces] == [RIGHT, LEFT]
    assert lens.vertices[0] == pytest.approx((0, -8))
    assert lens.vertices[1] == pytest.approx((0, 8))


def test_a_disc_that_is_cut_into_two() -> None:
    """A line and a circle that bulges over it leave a tip above and a tip below."""
    region = region_between(
        [half_circle(0, 0, -1, LEFT), half_circle(-8, 0, 1, Limit.RHO2_MAX)],
        [line(-1, RIGHT)],
        [BAND],
    )
    low, high = region.loops
    assert len(low) == len(high)
    assert region.area_mm2 == pytest.approx(2 * sum(0.5 * piece.twice_area_mm2 for piece in high))
    assert region.contains(-3, 9)
    assert region.contains(-3, -9)
    assert not region.contains(-3, 0)


def test_two_parts_that_touch_in_a_point_are_two_loops() -> None:
    region = region_between([half_circle(-RADIUS, 0, 1, LEFT)], [line(0, RIGHT)], [BAND])
    assert len(region.loops) == 2
    assert region.area_mm2 == pytest.approx(200 - math.pi * 50)


@pytest.mark.parametrize("gap", [0.0, 1e-14, -1e-14, 1e-12])
def test_touching_circles_have_nothing_between(gap: float) -> None:
    touching = region_between(
        [half_circle(RADIUS + gap, 0, -1, LEFT)], [half_circle(-RADIUS, 0, 1, RIGHT)], [BAND]
    )
    assert touching.area_mm2 == pytest.approx(0, abs=1e-9)


def test_circles_that_overlap_by_little() -> None:
    overlap = 1e-6
    lens = region_between(
        [half_circle(RADIUS - overlap, 0, -1, LEFT)],
        [half_circle(-RADIUS, 0, 1, RIGHT)],
        [BAND],
    )
    assert lens.area_mm2 == pytest.approx(lens_area(2 * RADIUS - overlap), rel=1e-3)


def test_coincident_flanks_count_once() -> None:
    twice = region_between(
        [half_circle(0, 0, -1, LEFT), half_circle(0, 0, -1, LEFT)],
        [half_circle(0, 0, 1, RIGHT)],
        [BAND],
    )
    assert twice.area_mm2 == pytest.approx(math.pi * 100)
    assert len(twice.pieces) == 2


def test_bands_close_a_region_below_and_above() -> None:
    slab = region_between([line(1, LEFT)], [line(4, RIGHT)], [BAND])
    assert slab.area_mm2 == pytest.approx(60)
    limits = [piece.limit for piece in slab.pieces]
    assert limits == [RIGHT, Limit.LEG_LENGTH, LEFT, Limit.ASSEMBLY_SIDE]
    assert all(isinstance(piece, Segment) for piece in slab.pieces)


def test_each_band_has_its_own_loop() -> None:
    bands = [BAND._replace(y_high_mm=-2), BAND._replace(y_low_mm=3)]
    assert region_between([line(1, LEFT)], [line(4, RIGHT)], bands).area_mm2 == pytest.approx(45)


@pytest.mark.parametrize("band", [BAND._replace(y_low_mm=10), BAND._replace(y_low_mm=11)])
def test_an_empty_band_holds_nothing(band: Band) -> None:
    assert region_between([line(1, LEFT)], [line(4, RIGHT)], [band]).is_empty


def test_where_flanks_cross() -> None:
    one, other = half_circle(0, 0, 1, LEFT), half_circle(12, 0, -1, RIGHT)
    assert sorted(crossing_heights(one, other)) == pytest.approx([-8, 8])
    assert sorted(crossing_heights(one, line(6, RIGHT))) == pytest.approx([-8, 8])
    assert sorted(crossing_heights(line(6, RIGHT), one)) == pytest.approx([-8, 8])
    assert crossing_heights(one, half_circle(21, 0, -1, RIGHT)) == ()
    assert crossing_heights(line(1, LEFT), line(1, RIGHT)) == ()
    # a circle straight above: both points at the same height
    assert crossing_heights(one, half_circle(0, 12, 1, RIGHT)) == pytest.approx((6, 6))
