"""On which side of their play the carriages rest."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drivers.robot import (
    BoardState,
    CommandedJoints,
    LimitSwitches,
    MeasuredJoints,
    RobotState,
)
from drivers.simulator.actuators import with_play
from server.control.taken_up import RUN_UP_MM, TakenUp, below
from twin.geometry import RobotGeometry
from twin.joints import JointPosition, JointVelocity
from twin.motion import JointState, MotionLimits, MotionPlan, plan_from_below, plan_joint_move

LIMITS, GEOMETRY = MotionLimits(), RobotGeometry()
REST = JointVelocity(0.0, 0.0, 0.0)
carriages = st.floats(RUN_UP_MM, 400.0)
joints = st.builds(JointPosition, carriages, carriages, st.floats(50.0, 150.0))


def _told(position: JointPosition) -> RobotState:
    return RobotState(
        sampled_at_s=0.0,
        received_at_s=0.0,
        board=BoardState.RUN,
        measured=MeasuredJoints(position, REST),
        commanded=CommandedJoints(position, REST),
        force_n=0.0,
        enabled=True,
        homed=True,
        switches=LimitSwitches(*(False,) * 3),
        queue_free=16,
        segments_done=0,
        fault=None,
    )


def _ways(plan: MotionPlan) -> list[JointPosition]:
    return [plan.position_at(t_s) for t_s in np.arange(0.0, plan.duration_s + 0.01, 0.01)]


@given(joints, joints, joints, st.floats(0.0, 1.0))
@settings(max_examples=60, deadline=None)
def test_a_gap_is_taken_up_from_wherever_the_carriages_come_and_however_they_are_bent(
    start: JointPosition, first: JointPosition, last: JointPosition, bent_at: float
) -> None:
    play, play_mm, stood_mm = TakenUp(), 0.3, list(start)
    plan = plan_from_below(LIMITS, start, first, below(GEOMETRY, first), taken_up=False)
    bent_s = bent_at * plan.duration_s
    on_the_way = plan.state_at(bent_s)
    bent = plan_from_below(LIMITS, on_the_way, last, below(GEOMETRY, last), taken_up=False)
    way = [at for i, at in enumerate(_ways(plan)) if 0.01 * i < bent_s] + _ways(bent)
    for told in way:
        play.follow(_told(told))
        stood_mm = [with_play(a, b, play_mm) for a, b in zip(stood_mm, told, strict=True)]
    if play.from_below:  # else the robot goes below by itself once more
        assert stood_mm[:2] == pytest.approx([q - 0.5 * play_mm for q in last[:2]], abs=0.03)
    else:
        assert bent_s > 0.0


@given(joints, joints)
@settings(max_examples=60, deadline=None)
def test_it_comes_from_below_without_a_stop_and_hardly_later(
    start: JointPosition, target: JointPosition
) -> None:
    plan = plan_from_below(LIMITS, start, target, below(GEOMETRY, target), taken_up=False)
    play = TakenUp()
    for told in _ways(plan):
        play.follow(_told(told))
    assert play.from_below
    assert plan.end == JointState.at_rest(target)
    assert plan.duration_s <= plan_joint_move(LIMITS, start, target).duration_s + 0.55
    speed = plan.sample(np.linspace(0.0, plan.duration_s, 400)).velocity_mm_s
    assert np.all(np.abs(speed) <= np.array([one.velocity_mm_s for one in LIMITS.joints]) + 1e-6)


def test_what_nobody_saw_is_not_believed() -> None:
    play, seen = TakenUp(), []
    for right_mm in (100.0, 102.0, 101.9, 102.0):
        play.follow(_told(JointPosition(right_mm, right_mm, 60.0)))
        seen.append(play.from_below)
    assert seen == [False, True, False, True]
    play.follow(replace(_told(JointPosition(102.0, 102.0, 60.0)), enabled=False))
    assert not play.from_below
