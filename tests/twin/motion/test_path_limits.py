from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.twin.motion.bounds import SLACK, limit_arrays
from tests.twin.strategies import between, default_tips
from twin.geometry import RobotGeometry
from twin.joints import TipPosition
from twin.kinematics import inverse
from twin.motion import MotionLimits
from twin.motion.path_limits import path_limits, rest_to_rest_time_s
from twin.motion.tip_line import PathDerivatives, TipLine
from twin.motion.trajectory import AxisLimits, solve_position

UNEVEN = RobotGeometry(e1y_mm=30, e2y_mm=-20)
LIMITS = MotionLimits()


@given(between(1e-3, 500), between(1, 100), between(10, 1000), between(100, 10000))
def test_closed_form_time_is_that_of_the_planner(
    length: float, velocity: float, acceleration: float, jerk: float
) -> None:
    axis = AxisLimits(velocity, acceleration, jerk)
    planned = solve_position([axis], [0.0], [0.0], [0.0], [length]).duration
    closed = rest_to_rest_time_s(length, *(np.array([limit]) for limit in axis))
    assert closed[0] == pytest.approx(planned, rel=1e-6)


def test_unusable_limits_take_for_ever() -> None:
    times = rest_to_rest_time_s(1.0, np.array([0.0, 1, 1]), np.array([1, -1.0, 1]), np.ones(3))
    assert times.tolist()[:2] == [np.inf, np.inf]
    assert np.isfinite(times[2])


def test_a_joint_in_proportion_to_the_path_keeps_its_own_limits() -> None:
    """rho3 moves twice as far as the path: half of 14, 100 and 1500."""
    derivatives = PathDerivatives((0.0, 0.0, 2.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    assert path_limits(LIMITS, derivatives, 50.0) == pytest.approx((7, 50, 750))


@given(default_tips(), default_tips())
def test_the_derivatives_on_the_line_are_slopes_and_never_exceed_their_bound(
    start: TipPosition, target: TipPosition
) -> None:
    line = TipLine.between(UNEVEN, inverse(UNEVEN, start), target)
    largest = line.largest_derivatives()
    step = 1e-3
    for distance in np.linspace(step, max(line.length_mm - step, step), 7).tolist():
        here = line.derivatives_at(distance)
        before, after = line.derivatives_at(distance - step), line.derivatives_at(distance + step)
        moved = np.subtract(line.joints_at(distance + step), line.joints_at(distance - step))
        np.testing.assert_allclose(here.first, moved / (2 * step), atol=1e-7)
        np.testing.assert_allclose(
            here.second, np.subtract(after.first, before.first) / (2 * step), atol=1e-8
        )
        np.testing.assert_allclose(
            here.third, np.subtract(after.second, before.second) / (2 * step), atol=1e-8
        )
        if line.length_mm > 2 * step:
            assert np.all(np.abs(here) <= np.array(largest) + 1e-15)


Triple = tuple[float, float, float]


@given(
    st.tuples(between(0.01, 2), between(0.01, 2), between(0.01, 2)),
    st.tuples(between(0, 0.02), between(0, 0.02), between(0, 0.02)),
    st.tuples(between(0, 1e-4), between(0, 1e-4), between(0, 1e-4)),
    between(0.01, 500),
)
def test_no_joint_can_exceed_its_limits_anywhere_on_the_path(
    slope: Triple, curve: Triple, twist: Triple, length: float
) -> None:
    """The chain rule with every derivative at its largest at once."""
    derivatives = PathDerivatives(slope, curve, twist)
    v, a, j = path_limits(LIMITS, derivatives, length)
    first, second, third = np.array(derivatives)
    velocity, acceleration, jerk = limit_arrays(LIMITS)
    assert np.all(first * v <= velocity * SLACK)
    assert np.all(first * a + second * v**2 <= acceleration * SLACK)
    assert np.all(first * j + 3 * second * v * a + third * v**3 <= jerk * SLACK)
    assert min(v, a, j) > 0
