from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings

from tests.twin.strategies import between
from tests.twin.workspace.robots import DEFAULT, Array, robots, stroke_left
from twin.geometry import RobotGeometry
from twin.workspace import (
    InvalidRectangleError,
    Limit,
    Rectangle,
    RectangleOutsideError,
    compare_with_lame,
    lame_margins,
    largest_rectangle,
    stroke_margins,
)


def curve(x: float, y: float, half: float, n: int, count: int) -> Array:
    turn = np.linspace(0, 2 * np.pi, count)
    radius = half / (np.cos(turn) ** n + np.sin(turn) ** n) ** (1 / n)
    directions = np.column_stack((np.cos(turn), np.sin(turn)))
    return np.asarray(np.array([x, y]) + radius[:, None] * directions)


@settings(max_examples=30)
@given(robots(), between(0.1, 0.95))
def test_the_margins_are_those_of_the_curve(geometry: RobotGeometry, share: float) -> None:
    best = largest_rectangle(geometry).rectangle
    half = 0.5 * share * best.height_mm
    assume(half > 1)
    for n in (6, 12):
        margins = lame_margins(geometry, best.center_x_mm, best.center_y_mm, half, n)
        points = curve(best.center_x_mm, best.center_y_mm, half, n, 5001)
        # on the curve as the paper writes it
        left = np.abs((points - [best.center_x_mm, best.center_y_mm]) / half) ** n
        np.testing.assert_allclose(left.sum(axis=1), 1)
        joints = [m for m in margins.all if m.limit.value.startswith("rho")]
        least = min(margin.value_mm for margin in joints)
        sampled = float(stroke_left(geometry, points).min())
        assert least <= sampled + 1e-9
        assert least == pytest.approx(sampled, abs=1e-2)


def test_it_understates_the_stroke_that_the_square_needs() -> None:
    six, twelve = compare_with_lame(DEFAULT, 650, 335, 100)
    assert (six.exponent, twelve.exponent) == (6, 12)
    assert six.square == stroke_margins(DEFAULT, Rectangle.square(650, 335, 200))
    for limit in (Limit.RHO1_MIN, Limit.RHO1_MAX, Limit.RHO2_MIN, Limit.RHO2_MAX):
        assert six.hidden_stroke_mm[limit] > twelve.hidden_stroke_mm[limit] > 5
    assert six.hidden_stroke_mm[Limit.RHO1_MIN] == pytest.approx(15.138, abs=1e-3)
    assert twelve.hidden_stroke_mm[Limit.RHO1_MAX] == pytest.approx(13.181, abs=1e-3)
    # the curve touches the middles of the square's edges
    assert six.hidden_stroke_mm[Limit.ASSEMBLY_SIDE] == pytest.approx(0, abs=1e-9)
    assert six.largest_square_half_side_mm == pytest.approx(111.99575, abs=1e-5)
    assert six.overstated_half_side_mm == pytest.approx(12.12297, abs=1e-4)
    assert twelve.overstated_half_side_mm == pytest.approx(5.94243, abs=1e-4)


def test_it_finds_room_for_a_square_that_does_not_fit() -> None:
    half = 117.0
    assert lame_margins(DEFAULT, 650, 335, half, 12).fits
    assert not stroke_margins(DEFAULT, Rectangle.square(650, 335, 2 * half)).fits


def test_it_becomes_the_square_as_the_exponent_grows() -> None:
    square = stroke_margins(DEFAULT, Rectangle.square(650, 335, 200))
    curve = lame_margins(DEFAULT, 650, 335, 100, 400)
    for one, other in zip(curve.all, square.all, strict=True):
        assert one.value_mm == pytest.approx(other.value_mm, abs=0.6)
        assert one.value_mm >= other.value_mm - 1e-9


def test_the_exponent_two_is_a_disc() -> None:
    """The farthest point of a disc within a circle lies on the line of both centres."""
    margins = lame_margins(DEFAULT, 650, 335, 50, 2)
    distance = math.hypot(650 - 55, 335)
    low = margins.rho1_min
    assert math.dist(low.at, (650, 335)) == pytest.approx(50)
    assert low.value_mm < distance - 532
    rho1 = low.at.x_mm - 55 - math.sqrt(532**2 - low.at.y_mm**2)
    assert low.value_mm == pytest.approx(rho1)


@pytest.mark.parametrize("exponent", [0, 1, 3, -2])
def test_exponents_that_make_no_such_curve(exponent: int) -> None:
    with pytest.raises(InvalidRectangleError, match="smooth square"):
        lame_margins(DEFAULT, 650, 335, 100, exponent)


def test_other_bad_questions() -> None:
    with pytest.raises(InvalidRectangleError):
        lame_margins(DEFAULT, 650, 335, -1, 6)
    with pytest.raises(RectangleOutsideError):
        compare_with_lame(DEFAULT, 100, 335, 100)
