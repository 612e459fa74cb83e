from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given

from tests.twin.motion.bounds import limit_arrays
from tests.twin.strategies import between, default_joints, default_tips
from twin.geometry import RobotGeometry
from twin.joints import JointPosition, JointVelocity, TipPosition
from twin.kinematics import inverse
from twin.motion import (
    InvalidMotionError,
    JointState,
    MotionLimits,
    MotionPlan,
    Segment,
    plan_joint_move,
    plan_segments,
    plan_stop,
    plan_straight_line,
)

DEFAULT = RobotGeometry()
LIMITS = MotionLimits()
HERE = JointPosition(180, 180, 100)


def assert_segments_make(plan: MotionPlan, segments: list[Segment]) -> None:
    first, last = segments[0], segments[-1]
    assert first.start == plan.start.position
    assert first.velocity == plan.start.velocity
    assert last.end == pytest.approx(plan.end.position, abs=1e-9)
    assert last.end_velocity == pytest.approx(plan.end.velocity, abs=1e-9)
    assert sum(segment.duration_s for segment in segments) == pytest.approx(plan.duration_s)
    for before, after in pairwise(segments):
        assert after.start == pytest.approx(before.end, abs=1e-9)
        assert after.velocity == pytest.approx(before.end_velocity, abs=1e-9)


def deviation_mm(plan: MotionPlan, segments: list[Segment]) -> np.ndarray:
    """Largest distance of each joint from the plan, shape (3,)."""
    inside = [
        (index * segment.duration_s + t_s, segment.position_at(t_s))
        for index, segment in enumerate(segments)
        for t_s in np.linspace(0, segment.duration_s, 4).tolist()
    ]
    planned = plan.sample(np.array([t_s for t_s, _ in inside])).position_mm
    largest: np.ndarray = np.abs(planned - np.array([q for _, q in inside])).max(axis=0)
    return largest


def stated_bound_mm(segment_s: float) -> np.ndarray:
    bound: np.ndarray = segment_s**2 / 4 * limit_arrays(LIMITS)[1] + 1e-9
    return bound


@given(default_joints(), default_joints(), between(0.005, 0.05))
def test_moves_from_rest(start: JointPosition, target: JointPosition, segment_s: float) -> None:
    plan = plan_joint_move(LIMITS, start, target)
    assume(plan.duration_s > 0)
    segments = plan_segments(plan, segment_s)
    assert_segments_make(plan, segments)
    assert all(segment.duration_s <= segment_s * (1 + 1e-9) for segment in segments)
    assert np.all(deviation_mm(plan, segments) <= stated_bound_mm(segment_s))


@given(default_joints(), default_joints(), default_joints(), between(0, 1))
def test_moves_that_start_in_motion(
    start: JointPosition, first: JointPosition, second: JointPosition, when: float
) -> None:
    flying = plan_joint_move(LIMITS, start, first)
    state = flying.state_at(when * flying.duration_s)
    for plan in (plan_joint_move(LIMITS, state, second), plan_stop(LIMITS, state)):
        if plan.duration_s == 0:
            continue
        segments = plan_segments(plan)
        assert_segments_make(plan, segments)
        assert np.all(deviation_mm(plan, segments) <= stated_bound_mm(0.02))


@given(default_tips(), default_tips())
def test_straight_lines(start: TipPosition, target: TipPosition) -> None:
    plan = plan_straight_line(DEFAULT, LIMITS, inverse(DEFAULT, start), target)
    assume(plan.duration_s > 0)
    segments = plan_segments(plan)
    assert_segments_make(plan, segments)
    assert np.all(deviation_mm(plan, segments) <= stated_bound_mm(0.02))


def test_segments_from_rest_keep_the_limits_of_speed_and_acceleration() -> None:
    plan = plan_joint_move(LIMITS, HERE, JointPosition(300, 90, 140))
    velocity, acceleration, _ = limit_arrays(LIMITS)
    for segment in plan_segments(plan):
        assert np.all(np.abs(segment.velocity) <= velocity * (1 + 1e-4))
        assert np.all(np.abs(segment.acceleration) <= acceleration * (1 + 1e-4))


def test_the_grid_covers_the_plan_exactly() -> None:
    """2.8 s by hand (200 mm at 80 mm/s): 140 segments of 20 ms, not 141 through rounding."""
    plan = plan_joint_move(LIMITS, HERE, HERE._replace(rho1_mm=380))
    segments = plan_segments(plan, 0.02)
    assert len(segments) == 140
    assert segments[0].duration_s == pytest.approx(0.02)


@pytest.mark.parametrize("travel_mm", [1e-9, 1e-6, 1e-3])
def test_a_move_shorter_than_a_segment(travel_mm: float) -> None:
    plan = plan_joint_move(LIMITS, HERE, HERE._replace(rho3_mm=100 + travel_mm))
    segments = plan_segments(plan)
    assert len(segments) >= 2
    assert_segments_make(plan, segments)


def test_a_joint_at_rest_stays_exactly_where_it_is() -> None:
    plan = plan_joint_move(LIMITS, HERE, HERE._replace(rho3_mm=140))
    assert {segment.start[:2] for segment in plan_segments(plan)} == {HERE[:2]}


def test_a_plan_that_takes_no_time_has_no_segments() -> None:
    assert plan_segments(plan_joint_move(LIMITS, HERE, HERE)) == []
    assert plan_segments(plan_stop(LIMITS, JointState.at_rest(HERE))) == []


def test_a_stop_of_one_joint() -> None:
    plan = plan_stop(LIMITS, JointState(HERE, JointVelocity(0, 0, 14)))
    assert_segments_make(plan, plan_segments(plan))


@pytest.mark.parametrize("segment_s", [0.0, -0.02, float("nan")])
def test_segments_need_a_duration(segment_s: float) -> None:
    plan = plan_joint_move(LIMITS, HERE, HERE._replace(rho3_mm=140))
    with pytest.raises(InvalidMotionError, match="must be greater than zero"):
        plan_segments(plan, segment_s)
