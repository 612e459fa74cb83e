"""The hanging cable."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from viser.transforms import SO3

from twin.scene import cable
from twin.statics import Loads

SPEC = cable.Cable.of(Loads())
LENGTH_MM = SPEC.length_mm

coordinate = st.floats(-600, 600)
points = st.tuples(coordinate, coordinate, coordinate).map(np.array)


def hanging(start: list[float], end: list[float], segments: int) -> cable.Points:
    return cable.hanging(
        np.array(start, float), np.array(end, float), length_mm=LENGTH_MM, segments=segments
    )


def length_of(line: cable.Points) -> float:
    return float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum())


@given(points, points)
def test_it_has_its_length_and_both_its_ends(start: cable.Points, end: cable.Points) -> None:
    assume(np.linalg.norm(end - start) < LENGTH_MM - 1)
    assume(np.hypot(*(end - start)[[0, 2]]) > 5)
    line = cable.hanging(start, end, length_mm=LENGTH_MM, segments=4000)
    assert line[0] == pytest.approx(start, abs=1e-6)
    assert line[-1] == pytest.approx(end, abs=1e-6)
    assert line[-2] == pytest.approx(end, abs=1.1 * LENGTH_MM / 4000)
    # Chords are shorter than the arc, most of all in the sharp bend of a nearly closed loop.
    assert length_of(line) == pytest.approx(LENGTH_MM, rel=2e-4)


def test_it_hangs_as_the_lightest_chain_does() -> None:
    line = hanging([0.0, 100, 0], [800.0, -50, 300], 2000)
    horizontal = np.hypot(line[:, 0], line[:, 2])
    slope = np.diff(line[:, 1]) / np.diff(horizontal)
    # The slope of a hanging chain grows evenly with its arc, which is evenly divided here.
    steps = np.diff(slope)
    assert steps == pytest.approx(np.full(len(steps), steps.mean()), rel=1e-3)
    assert line[:, 1].min() < -300
    # All of it is in the vertical plane through its ends.
    assert line[:, 2] == pytest.approx(line[:, 0] * 300 / 800, abs=1e-6)


@pytest.mark.parametrize("reach", [1499.999999, 1500.0, 1700.0])
def test_a_cable_that_is_too_short_is_drawn_straight(reach: float) -> None:
    line = hanging([0, 0, 0], [reach, 0.0, 0.0], 10)
    assert line[:, 1] == pytest.approx(np.zeros(11), abs=1)
    assert line[:, 0] == pytest.approx(np.linspace(0, reach, 11), abs=1)


def test_both_ends_above_each_other_make_a_narrow_loop() -> None:
    line = hanging([0, 0, 0], [0.0, 300.0, 0.0], 400)
    assert np.isfinite(line).all()
    assert line[:, 1].min() == pytest.approx(-600, abs=5)


@given(points, points)
def test_every_link_lies_along_the_cable(start: cable.Points, end: cable.Points) -> None:
    assume(np.linalg.norm(end - start) > 1)
    line = cable.hanging(start, end, length_mm=LENGTH_MM)
    middles, turns = cable.along(line)
    assert middles.shape == (cable.SEGMENTS, 3)
    for middle, wxyz, a, b in zip(middles, turns, line, line[1:], strict=False):
        direction = SO3(wxyz).as_matrix()[:, 2]
        assert middle + direction * np.linalg.norm(b - a) / 2 == pytest.approx(b, abs=1e-6)


@given(points, points)
def test_both_ends_together_carry_its_weight(start: cable.Points, end: cable.Points) -> None:
    assume(np.linalg.norm(end - start) < LENGTH_MM - 20)
    assume(np.hypot(*(end - start)[[0, 2]]) > 5)
    at_end, at_start = cable.pull_n(SPEC, start, end), cable.pull_n(SPEC, end, start)
    assert at_end is not None
    assert at_start is not None
    # The pull on both holders together is the weight of 1.4 kg; sideways it cancels out.
    assert at_end + at_start == pytest.approx(np.array([0, -13.729, 0]), abs=1e-3)


def test_it_pulls_along_its_own_last_link() -> None:
    start, end = np.array([0.0, 100, 0]), np.array([800.0, -50, 300])
    pull = cable.pull_n(SPEC, start, end)
    assert pull is not None
    line = cable.hanging(start, end, length_mm=LENGTH_MM, segments=20_000)
    inwards = line[-2] - line[-1]
    assert pull / np.linalg.norm(pull) == pytest.approx(inwards / np.linalg.norm(inwards), abs=1e-3)


def test_a_heavier_cable_pulls_harder_in_the_same_direction() -> None:
    ends = np.zeros(3), np.array([700.0, 100.0, 0.0])
    light, heavy = (cable.pull_n(cable.Cable(LENGTH_MM, m), *ends) for m in (1.4, 1.85))
    assert light is not None
    assert heavy == pytest.approx(light * 1.85 / 1.4)


def test_how_hard_a_taut_cable_pulls_is_not_known() -> None:
    assert cable.pull_n(SPEC, np.zeros(3), np.array([1600.0, 0, 0])) is None


@pytest.mark.parametrize(
    ("length_mm", "mass_kg"), [(0, 1), (-1, 1), (1, -1), (np.inf, 1), (1, np.nan)]
)
def test_a_cable_without_length_or_below_no_mass_is_refused(
    length_mm: float, mass_kg: float
) -> None:
    with pytest.raises(ValueError, match="greater than zero"):
        cable.Cable(length_mm, mass_kg)
