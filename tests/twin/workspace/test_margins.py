from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.twin.strategies import between
from tests.twin.workspace.robots import DEFAULT, LONG_STROKES, points_in, robots
from twin.geometry import RobotGeometry
from twin.kinematics import alpha
from twin.workspace import (
    Limit,
    Point,
    Rectangle,
    RectangleOutsideError,
    fits,
    paper_discs,
    reachable_region,
    require_fit,
    stroke_margins,
)

REGULAR = Rectangle.of_box(DEFAULT.regular_box)


def test_the_regular_square() -> None:
    """It needs rho1 and rho2 from 17.7 to 388.7 mm."""
    margins = stroke_margins(DEFAULT, REGULAR)
    assert margins.rho1_min.value_mm == pytest.approx(17.717, abs=1e-3)
    assert 420 - margins.rho1_max.value_mm == pytest.approx(388.734, abs=1e-3)
    assert margins.rho1_min.at == Point(550, 235)
    assert margins.rho1_max.at == Point(750, 435)
    assert margins.rho2_min.at == Point(750, 235)
    assert margins.rho2_max.at == Point(550, 435)
    assert margins.rho2_min.value_mm == pytest.approx(margins.rho1_min.value_mm)
    assert margins.rho2_max.value_mm == pytest.approx(margins.rho1_max.value_mm)
    assert margins.assembly_side.value_mm == pytest.approx(235)
    assert margins.leg_length.value_mm == 97
    assert margins.smallest.limit in {Limit.RHO1_MIN, Limit.RHO2_MIN}
    assert margins.fits
    assert require_fit(DEFAULT, REGULAR) == margins


@settings(max_examples=80)
@given(robots(), st.data())
def test_they_are_the_extremes_over_the_whole_rectangle(
    geometry: RobotGeometry, data: st.DataObject
) -> None:
    """No sample has less stroke left, and the named position has just that."""
    x_min, x_max, y_min, y_max = reachable_region(geometry).extent
    low, high = sorted(data.draw(st.tuples(between(y_min, y_max), between(y_min, y_max))))
    assume(high - low > 1e-3 and low > y_min + 1e-6 and high < y_max - 1e-3)
    left, width = data.draw(between(x_min, x_max)), data.draw(between(1, 300))
    rectangle = Rectangle(left + width / 2, (low + high) / 2, width, high - low)
    edges = (rectangle.x_min_mm, rectangle.x_max_mm, low, high)
    rho = alpha.inverse_many(geometry, points_in(edges, 201))
    assume(not np.isnan(rho).any())
    margins = stroke_margins(geometry, rectangle)
    for index, travel, least, greatest in (
        (0, geometry.rho1, margins.rho1_min, margins.rho1_max),
        (1, geometry.rho2, margins.rho2_min, margins.rho2_max),
    ):
        sampled_least = rho[..., index].min() - travel.min_mm
        sampled_greatest = travel.max_mm - rho[..., index].max()
        # between two samples the circle's widest point is missed by less than a step
        assert sampled_least - (high - low) / 200 <= least.value_mm <= sampled_least + 1e-7
        assert greatest.value_mm == pytest.approx(sampled_greatest, abs=1e-4)
        at = alpha.inverse_many(geometry, np.array([least.at, greatest.at]))[:, index]
        assert at[0] - travel.min_mm == pytest.approx(least.value_mm, abs=1e-4)
        assert travel.max_mm - at[1] == pytest.approx(greatest.value_mm, abs=1e-4)


def test_a_square_that_only_just_fits() -> None:
    """The lower corners of a square on the lowest place touch the starts of both strokes."""
    lowest = Rectangle.square(650, 294.93332193342417, 200)
    assert fits(DEFAULT, lowest)
    assert not fits(DEFAULT, Rectangle.square(650, 294.93332193342417 - 1e-6, 200))


@pytest.mark.parametrize(
    ("rectangle", "limit", "sentence"),
    [
        (Rectangle.square(600, 335, 200), "rho1_min", r"\(500\.0, 235\.0\) it is 32\.3 mm beyond"),
        (Rectangle.square(700, 335, 200), "rho2_min", r"\(800\.0, 235\.0\)"),
        (Rectangle.square(650, 390, 200), "rho1_max", r"\(750\.0, 490\.0\)"),
        (Rectangle(650, 0, 10, 200), "assembly_side", r"100\.0 mm beyond the limit assembly_side"),
    ],
)
def test_squares_that_do_not_fit(rectangle: Rectangle, limit: str, sentence: str) -> None:
    assert not fits(DEFAULT, rectangle)
    with pytest.raises(RectangleOutsideError, match=sentence) as caught:
        require_fit(DEFAULT, rectangle)
    assert caught.value.code == "rectangle_outside"
    assert caught.value.context["limit"] == limit


def test_above_the_legs() -> None:
    margins = stroke_margins(LONG_STROKES, Rectangle.square(650, 500, 100))
    assert margins.leg_length.value_mm == pytest.approx(-18)
    assert not margins.fits


def test_long_strokes_serve_squares_that_the_discs_exclude() -> None:
    square = Rectangle.square(650, 415, 200)
    assert fits(LONG_STROKES, square)
    discs = paper_discs(LONG_STROKES, square)
    assert not discs.all_hold
    assert discs.within_left_end_mm < 0
    assert discs.beyond_left_start_mm > 0
