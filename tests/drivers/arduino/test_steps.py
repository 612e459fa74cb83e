from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.arduino.protocol.messages import MAX_SEGMENT_TICKS, TICK_HZ
from drivers.arduino.scale import ONE_UNIT, AxisScale
from drivers.arduino.settings import BoardSettings
from drivers.arduino.steps import (
    nearest_within_unit,
    phase,
    point_after,
    position_after,
    rate_after,
    segment_end,
    ticks_of,
    whole,
    wire_segment,
)
from twin.joints import JointPosition
from twin.motion import MotionLimits, plan_joint_move, plan_segments

SCALES = [AxisScale(axis.units_per_mm) for axis in BoardSettings().axes]
LIMITS = MotionLimits()

rates = st.integers(-(2**31) + 1, 2**31 - 1)
joints = st.builds(JointPosition, st.floats(0, 420), st.floats(0, 420), st.floats(50, 150))


@given(start=st.integers(-(2**50), 2**50), rate=rates, end_rate=rates, ticks=st.integers(1, 300))
def test_the_closed_form_is_what_the_board_adds_up(
    start: int, rate: int, end_rate: int, ticks: int
) -> None:
    acceleration = (end_rate - rate) // ticks
    position, now, steps = start, rate, 0
    for _ in range(ticks):
        before = whole(position)
        position += now
        step = whole(position) - before
        assert step in {-1, 0, 1}
        assert step * now >= 0, "a step goes where the rate points"
        now += acceleration
        steps += step
    assert position_after(start, rate, acceleration, ticks) == position
    assert rate_after(rate, acceleration, ticks) == now
    assert whole(position) == whole(start) + steps


@given(position=st.integers(-(2**60), 2**60))
def test_units_and_phase_make_the_position(position: int) -> None:
    assert (whole(position) << 31) + phase(position) == position
    assert 0 <= phase(position) < ONE_UNIT


@given(start=joints, target=joints)
def test_a_plan_becomes_a_chain_without_gaps(start: JointPosition, target: JointPosition) -> None:
    here = tuple(scale.position(mm) for scale, mm in zip(SCALES, start, strict=True))
    end = (here[0], here[1], here[2])
    rate = (0, 0, 0)
    for number, segment in enumerate(plan_segments(plan_joint_move(LIMITS, start, target))):
        wire = wire_segment(segment, number, end, SCALES)
        assert wire.start == tuple(map(whole, end))
        assert wire.phase == tuple(map(phase, end))
        for scale, jump in zip(
            SCALES, (a - b for a, b in zip(wire.rate, rate, strict=True)), strict=True
        ):
            assert abs(scale.mm_s(jump)) < 0.1, "nothing that a motor feels"
        reached = segment_end(wire)
        end, rate = reached.position, reached.rate
        for scale, position, wanted_mm in zip(SCALES, end, segment.end, strict=True):
            # rounding leaves less than n/2 of 2^-31 units behind, and never adds up
            assert abs(position - scale.position(wanted_mm)) <= wire.ticks / 2 + 1
        wire.pack()  # every number fits
    for scale, position, wanted_mm in zip(SCALES, end, target, strict=True):
        assert scale.mm(position) == pytest.approx(wanted_mm, abs=1e-6)


@given(start=joints, target=joints, share=st.floats(0, 1))
def test_on_the_way_the_board_is_where_the_plan_is(
    start: JointPosition, target: JointPosition, share: float
) -> None:
    segments = plan_segments(plan_joint_move(LIMITS, start, target))
    if not segments:
        return
    segment = segments[int(share * (len(segments) - 1))]
    here = [scale.position(mm) for scale, mm in zip(SCALES, segment.start, strict=True)]
    wire = wire_segment(segment, 0, (here[0], here[1], here[2]), SCALES)
    ticks = int(share * wire.ticks)
    point = point_after(wire, ticks)
    wanted = segment.position_at(ticks / wire.ticks * segment.duration_s)
    for scale, position, mm in zip(SCALES, point.position, wanted, strict=True):
        assert scale.mm(position) == pytest.approx(mm, abs=1e-5)


@pytest.mark.parametrize(
    ("duration_s", "ticks"),
    [(0.02, 400), (0.02 * (1 + 1e-9), 400), (0.0199, 398), (0.01998, 400), (1e-9, 1), (0.1, 2000)],
)
def test_durations_are_rounded_up_to_ticks(duration_s: float, ticks: int) -> None:
    assert ticks_of(duration_s) == ticks


def test_the_longest_segment_is_a_tenth_of_a_second() -> None:
    assert pytest.approx(0.1) == MAX_SEGMENT_TICKS / TICK_HZ


@given(wanted=st.integers(-(2**40), 2**40), units=st.integers(-400, 400))
def test_the_nearest_position_within_a_unit(wanted: int, units: int) -> None:
    found = nearest_within_unit(wanted, units)
    assert whole(found) == units
    if whole(wanted) == units:
        assert found == wanted
    else:
        assert phase(found) in {0, ONE_UNIT - 1}


@given(mm=st.floats(-500, 500))
def test_scales_there_and_back(mm: float) -> None:
    for scale in SCALES:
        assert scale.mm(scale.position(mm)) == pytest.approx(mm, abs=1e-9)
        assert abs(scale.mm_of_units(whole(scale.position(mm))) - mm) <= 0.51 / scale.units_per_mm
        assert scale.mm_s(scale.rate(mm)) == pytest.approx(mm, abs=1e-6)
