"""Force over depth: what is usual, how sure that is, and what stands out."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from tests.twin.divergence.samples import START, sample
from twin.divergence import Entry, Residual
from twin.divergence.insertion_force import InsertionForce, on_curve
from twin.divergence.numbers import ForceNumbers
from twin.joints import JointVelocity

NUMBERS = ForceNumbers()
FORCE = InsertionForce(NUMBERS)


def judged(depth_mm: float, force_n: float, *, speed_mm_s: float = 14.0) -> Residual:
    residual = FORCE.judge(depth_mm, speed_mm_s, force_n, face_sigma_mm=0.03)
    assert residual is not None
    return residual


def test_the_curve_goes_through_its_points_and_stays_level_outside() -> None:
    for depth_mm, share in NUMBERS.engagement:
        assert on_curve(NUMBERS.engagement, depth_mm) == pytest.approx(share)
    assert on_curve(NUMBERS.engagement, -5.0) == 0
    assert on_curve(NUMBERS.engagement, 45.0) == 0.6
    assert on_curve(NUMBERS.engagement, 33.0) == pytest.approx(0.75)


def test_seventy_newtons_plus_friction_are_usual_at_the_worst_depth() -> None:
    residual = judged(37.0, 70.0)
    assert residual.expected == pytest.approx(71.5)
    assert residual.sigmas < 1


@given(depth_mm=st.floats(-30, 45), scale=st.floats(0.93, 1.07), shift_mm=st.floats(-0.5, 0.5))
def test_good_sockets_raise_no_alarm(depth_mm: float, scale: float, shift_mm: float) -> None:
    share = on_curve(NUMBERS.engagement, depth_mm + shift_mm)
    assert judged(depth_mm, NUMBERS.peak_n * scale * share + 1.5).sigmas < 4


@pytest.mark.parametrize("depth_mm", [34.0, 36.0, 38.0])
def test_thirty_percent_too_much_stands_out(depth_mm: float) -> None:
    share = on_curve(NUMBERS.engagement, depth_mm)
    assert judged(depth_mm, 1.3 * NUMBERS.peak_n * share + 1.5).sigmas > 4


def test_a_plug_that_goes_nowhere_stands_out() -> None:
    assert judged(36.5, 2.0).sigmas > 10


def test_pushing_against_something_in_free_space_stands_out() -> None:
    blocked = sample(velocity=JointVelocity(0, 0, 14), force_n=40.0)
    residual = FORCE.compare(blocked, None)
    assert residual is not None
    assert residual.sigmas > 20


def test_only_a_pull_that_is_too_strong_counts_on_the_way_out() -> None:
    assert judged(30.0, -5.0, speed_mm_s=-14.0).sigmas == 0
    assert judged(39.0, 40.0, speed_mm_s=-14.0).sigmas == 0
    assert judged(20.0, -79.0, speed_mm_s=-14.0).sigmas > 10


def test_at_rest_the_force_says_nothing() -> None:
    assert FORCE.judge(37.0, 0.5, 200.0, 0.0) is None


def test_the_depth_counts_from_the_face() -> None:
    inside = sample(
        measured=START._replace(rho3_mm=117.0), velocity=JointVelocity(0, 0, 14), force_n=71.0
    )
    residual = FORCE.compare(inside, Entry(face_rho3_mm=80.0, sigma_mm=0.05))
    assert residual is not None
    assert residual.expected == pytest.approx(71.5)


def test_the_uncertain_depth_counts_where_the_force_changes_quickly() -> None:
    _, flat_n = FORCE.expected(37.0, 0.3, going_in=True)
    _, steep_n = FORCE.expected(33.0, 0.3, going_in=True)
    slope_n_mm = NUMBERS.peak_n * 0.5 / 6
    known = math.hypot(NUMBERS.peak_sigma * 52.5, NUMBERS.friction_sigma_n, NUMBERS.noise_n)
    assert steep_n == pytest.approx(math.hypot(known, slope_n_mm * 0.3))
    assert flat_n == pytest.approx(
        math.hypot(NUMBERS.peak_sigma * 70, NUMBERS.friction_sigma_n, NUMBERS.noise_n)
    )


def test_curves_must_ascend() -> None:
    with pytest.raises(ValidationError, match="ascending depth"):
        ForceNumbers(engagement=((0, 0), (4, 1), (2, 1)))
