from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.simulator.set_points import STILL, SetPointLine
from twin.joints import JointAcceleration, JointPosition, JointVelocity
from twin.motion.segments import Segment

DECELERATION = (1500.0, 1500.0, 400.0)


def new_line() -> SetPointLine:
    start = JointPosition(10.0, 20.0, 60.0)
    return SetPointLine(start, 0.0, deceleration_mm_s2=DECELERATION, still_mm_s=0.5)


def chain(
    start: JointPosition, velocity: JointVelocity, rates: list[tuple[float, float, float]]
) -> list[Segment]:
    """Segments of 20 ms, one behind the other, with the given accelerations."""
    segments = []
    for rate in rates:
        segment = Segment(0.02, start, velocity, JointAcceleration(*rate))
        segments.append(segment)
        start, velocity = segment.end, segment.end_velocity
    return segments


accelerations = st.tuples(*[st.floats(-400, 400)] * 3)
batches = st.lists(st.lists(accelerations, min_size=1, max_size=6), min_size=1, max_size=4)


@given(batches, st.floats(0.0, 0.5))
def test_the_line_is_continuous_whatever_was_pushed_and_wherever_it_is_cut(
    rates: list[list[tuple[float, float, float]]], cut_s: float
) -> None:
    line = new_line()
    for batch in rates:
        _, position, velocity = line.queue_end(0.0)
        line.append(0.0, chain(position, velocity, batch))
    line.brake(cut_s)
    end_s = line.rests_from_s
    step_s = 0.001
    before = line.at(0.0)
    for i in range(1, int((end_s + 0.05) / step_s)):
        now = line.at(i * step_s)
        for j in range(3):
            fastest = max(abs(before.velocity[j]), abs(now.velocity[j])) + 2.0
            assert abs(now.position[j] - before.position[j]) <= fastest * step_s
            # what still_mm_s lets pass as rest may drop at once
            assert abs(now.velocity[j] - before.velocity[j]) <= 1500.0 * step_s + 0.5 + 1e-6
        before = now
    assert line.at(end_s + 1.0).velocity == STILL


@given(batches, st.floats(0.0, 1.0))
def test_the_pieces_between_two_times_cover_them_without_gaps(
    rates: list[list[tuple[float, float, float]]], from_s: float
) -> None:
    line = new_line()
    for batch in rates:
        _, position, velocity = line.queue_end(0.0)
        line.append(0.0, chain(position, velocity, batch))
    now_s = from_s
    for until_s, piece in line.pieces_between(from_s, 2.0):
        assert until_s > now_s
        middle_s = 0.5 * (now_s + until_s)
        if piece is None:
            assert line.at(middle_s).velocity == STILL
        else:
            assert piece.start_s <= now_s
            assert until_s <= piece.end_s
            assert line.at(middle_s) == piece.at(middle_s)
        now_s = until_s
    assert now_s == 2.0


def test_an_empty_queue_with_velocity_left_brakes_by_itself() -> None:
    line = new_line()
    segments = chain(JointPosition(10.0, 20.0, 60.0), STILL, [(400.0, 0.0, 0.0)] * 5)
    line.append(1.0, segments)
    assert not line.ran_empty(1.0999)
    assert line.ran_empty(1.1)
    # 40 mm/s with 1500 mm/s^2
    assert line.rests_from_s == pytest.approx(1.1 + 40.0 / 1500.0)
    stopping_mm = 40.0**2 / (2 * 1500.0)
    assert line.at(9.0).position.rho1_mm == pytest.approx(segments[-1].end.rho1_mm + stopping_mm)


def test_a_plan_that_ends_at_rest_does_not_run_empty() -> None:
    line = new_line()
    start = JointPosition(10.0, 20.0, 60.0)
    line.append(0.0, chain(start, STILL, [(400.0, 0.0, 0.0), (-400.0, 0.0, 0.0)]))
    assert not line.ran_empty(5.0)
    when_s, where, speed = line.queue_end(5.0)
    assert (when_s, speed) == (5.0, STILL)
    assert where.rho1_mm == pytest.approx(10.16)


def test_braking_keeps_all_joints_on_their_straight_line() -> None:
    line = new_line()
    velocity = JointVelocity(60.0, -30.0, 6.0)
    line.append(
        0.0, [Segment(0.02, JointPosition(10, 20, 60), velocity, JointAcceleration(0, 0, 0))]
    )
    line.brake(0.01)
    end = line.at(9.0).position
    moved = (end.rho1_mm - 10, end.rho2_mm - 20, end.rho3_mm - 60)
    assert moved[0] / 60 == pytest.approx(moved[1] / -30)
    assert moved[0] / 60 == pytest.approx(moved[2] / 6)
    # no joint brakes harder than it may
    assert line.rests_from_s - 0.01 == pytest.approx(60.0 / 1500.0)


def test_segments_wait_until_they_are_done() -> None:
    line = new_line()
    start = JointPosition(10.0, 20.0, 60.0)
    line.append(0.0, chain(start, STILL, [(100.0, 0, 0), (0, 0, 0), (-100.0, 0, 0)]))
    assert [line.waiting(t) for t in (0.0, 0.021, 0.041, 0.061)] == [3, 2, 1, 0]


def test_after_a_stop_the_next_motion_begins_where_the_stop_ended() -> None:
    line = new_line()
    line.append(0.0, chain(JointPosition(10, 20, 60), STILL, [(400.0, 0, 0)] * 10))
    line.brake(0.1)
    when_s, where, speed = line.queue_end(2.0)
    assert (when_s, where, speed) == (2.0, line.at(2.0).position, STILL)
    line.append(2.0, chain(where, STILL, [(-400.0, 0, 0), (400.0, 0, 0)]))
    assert line.at(1.9).position == where
    assert line.at(2.04).position.rho1_mm == pytest.approx(where.rho1_mm - 0.16)


def test_forgetting_the_past_leaves_the_present_alone() -> None:
    line = new_line()
    line.append(0.0, chain(JointPosition(10, 20, 60), STILL, [(50.0, 0, 0), (-50.0, 0, 0)] * 50))
    times = [1.0 + 0.05 * i for i in range(40)]
    before = [line.at(t) for t in times]
    line.forget(1.0)
    assert [line.at(t) for t in times] == before
    assert len(line._pieces) < 60
