from __future__ import annotations

import pytest
from hypothesis import assume, given, settings

from tests.twin.strategies import between
from tests.twin.workspace.robots import DEFAULT
from twin.geometry import JointRange, RobotGeometry
from twin.workspace import (
    Rectangle,
    RectangleOutsideError,
    fits,
    offset_conditions,
    paper_discs,
    stroke_margins,
    v_abscissa_of_b,
)

REGULAR = Rectangle.square(650, 335, 200)


def test_the_paper_s_centre_is_the_abscissa_of_b() -> None:
    geometry = DEFAULT
    assert geometry.base_width_mm / 2 - geometry.platform_width_mm / 2 == 570
    assert v_abscissa_of_b(geometry, 570) == 650 == geometry.regular_box.center_x_mm


def test_read_as_the_abscissa_of_v_it_asks_for_uneven_offsets() -> None:
    conditions = offset_conditions(DEFAULT, Rectangle.square(570, 335, 200), 0)
    assert conditions.e1x_max_mm - conditions.e2x_max_mm == pytest.approx(-160)
    even = offset_conditions(DEFAULT, REGULAR, 0)
    assert even.e1x_max_mm == pytest.approx(even.e2x_max_mm)


def test_the_numbers_of_the_regular_square() -> None:
    conditions = offset_conditions(DEFAULT, REGULAR, 0)
    assert conditions.sentences() == (
        "-97.00 <= e1y = e2y = 0 <= 235.00",
        "e1x <= -7.28",
        "e1x + s1 >= 363.73",
        "e2x <= -7.28",
        "e2x + s2 >= 363.73",
        "so s1 >= 371.02 and s2 >= 371.02",
    )
    assert conditions.permits(e1x_mm=-25, s1_mm=420, e2x_mm=-25, s2_mm=420)
    margins = stroke_margins(DEFAULT, REGULAR)
    assert conditions.e1x_max_mm - -25 == pytest.approx(margins.rho1_min.value_mm)
    assert -25 + 420 - conditions.e1x_plus_s1_min_mm == pytest.approx(margins.rho1_max.value_mm)


@settings(max_examples=300)
@given(
    between(-120, 250),
    between(-150, 60),
    between(200, 700),
    between(-150, 60),
    between(200, 700),
)
def test_they_say_exactly_when_the_square_is_inside(
    e_y: float, e1x: float, s1: float, e2x: float, s2: float
) -> None:
    geometry = RobotGeometry(
        e1x_mm=e1x,
        e1y_mm=e_y,
        e2x_mm=e2x,
        e2y_mm=e_y,
        rho1=JointRange(min_mm=0, max_mm=s1),
        rho2=JointRange(min_mm=0, max_mm=s2),
    )
    assume(abs(stroke_margins(geometry, REGULAR).smallest.value_mm) > 1e-6)
    try:
        conditions = offset_conditions(geometry, REGULAR, e_y)
    except RectangleOutsideError:
        assert not fits(geometry, REGULAR)
        return
    permitted = conditions.permits(e1x_mm=e1x, s1_mm=s1, e2x_mm=e2x, s2_mm=s2)
    assert permitted is fits(geometry, REGULAR)


@given(between(-97, 235), between(0, 200))
def test_the_least_strokes_do_and_less_does_not(e_y: float, less: float) -> None:
    conditions = offset_conditions(DEFAULT, REGULAR, e_y)
    e1x, e2x, s1, s2 = (
        conditions.e1x_max_mm,
        conditions.e2x_max_mm,
        conditions.s1_min_mm,
        conditions.s2_min_mm,
    )
    assert conditions.permits(e1x_mm=e1x, s1_mm=s1, e2x_mm=e2x, s2_mm=s2)
    assume(less > 1e-6)
    assert not conditions.permits(e1x_mm=e1x, s1_mm=s1 - less, e2x_mm=e2x, s2_mm=s2)
    assert not conditions.permits(e1x_mm=e1x, s1_mm=s1, e2x_mm=e2x, s2_mm=s2 - less)
    assert not conditions.permits(e1x_mm=e1x + less, s1_mm=s1, e2x_mm=e2x, s2_mm=s2)
    assert not conditions.permits(e1x_mm=e1x, s1_mm=s1, e2x_mm=e2x + less, s2_mm=s2)


@pytest.mark.parametrize("e_y", [-97.1, 235.1])
def test_heights_of_the_carriages_that_nothing_makes_up_for(e_y: float) -> None:
    with pytest.raises(RectangleOutsideError, match=r"between -97 and 235 mm"):
        offset_conditions(DEFAULT, REGULAR, e_y)


@settings(max_examples=200)
@given(between(500, 800), between(200, 450), between(20, 300), between(300, 540))
def test_the_four_discs_agree_with_moderate_strokes(
    x: float, y: float, side: float, stroke: float
) -> None:
    """And the fifth condition, which the paper leaves out, is needed beside them."""
    travel = JointRange(min_mm=0, max_mm=stroke)
    geometry = RobotGeometry(rho1=travel, rho2=travel)
    square = Rectangle.square(x, y, side)
    assume(abs(stroke_margins(geometry, square).smallest.value_mm) > 1e-6)
    assert paper_discs(geometry, square).all_hold is fits(geometry, square)


def test_the_missing_fifth_condition() -> None:
    below = Rectangle.square(650, -335, 200)
    discs = paper_discs(DEFAULT, below)
    assert discs.above_carriages_mm == -435
    four = (
        discs.within_left_end_mm,
        discs.within_right_end_mm,
        discs.beyond_left_start_mm,
        discs.beyond_right_start_mm,
    )
    assert min(four) > 0
    assert not discs.all_hold
    assert not fits(DEFAULT, below)
