"""Is the board where the plan has it, and when?"""

from __future__ import annotations

import numpy as np
import pytest

from tests.twin.divergence.samples import START, sample
from twin.divergence.numbers import SetPointNumbers
from twin.divergence.plan_line import PlanLine
from twin.joints import JointPosition, JointVelocity
from twin.motion import MotionLimits, plan_joint_move, plan_segments
from twin.motion.segments import Segment

NUMBERS = SetPointNumbers()
TARGET = JointPosition(250.0, 180.0, 90.0)


def segments() -> list[Segment]:
    return list(plan_segments(plan_joint_move(MotionLimits(), START, TARGET), 0.02))


def worst_sigmas(*, late_s: float = 0.0, rate: float = 1.0) -> float:
    """A board that begins ``late_s`` later than usual and whose clock runs at ``rate``."""
    plan = plan_joint_move(MotionLimits(), START, TARGET)
    line = PlanLine(NUMBERS)
    line.append(segments(), 10.0)
    sigmas = [0.0]
    for t in np.arange(0.0, plan.duration_s, 0.01):
        on_board_s = rate * (float(t) - NUMBERS.start_delay_s - late_s)
        state = plan.state_at(on_board_s)
        residual = line.compare(
            sample(10.0 + float(t), commanded=state.position, velocity=state.velocity)
        )
        if residual is not None:
            sigmas.append(residual.sigmas)
    return max(sigmas)


def test_a_punctual_board_agrees() -> None:
    assert worst_sigmas() < 0.3


def test_a_link_that_takes_twenty_milliseconds_more_is_no_fault() -> None:
    assert worst_sigmas(late_s=0.02) < 2


@pytest.mark.parametrize(("late_s", "rate"), [(0.09, 1.0), (0.0, 0.9)])
def test_a_late_or_slow_board_shows(late_s: float, rate: float) -> None:
    assert worst_sigmas(late_s=late_s, rate=rate) > 4


def test_segments_follow_each_other_without_a_gap() -> None:
    line, parts = PlanLine(NUMBERS), segments()
    line.append(parts[:8], 10.0)
    line.append(parts[8:16], 10.05)
    half_s = 0.5 * parts[9].duration_s
    at_s = 10.0 + NUMBERS.start_delay_s + sum(part.duration_s for part in parts[:9]) + half_s
    residual = line.compare(sample(at_s, commanded=parts[9].position_at(half_s)))
    assert residual is not None
    assert residual.difference == pytest.approx(0.0, abs=1e-9)


def test_a_new_motion_after_a_stop_begins_anew() -> None:
    line, parts = PlanLine(NUMBERS), segments()
    line.append(parts[:8], 10.0)
    elsewhere = START._replace(rho1_mm=155.0)
    still = JointVelocity(0.0, 0.0, 0.0)
    line.append([Segment(0.02, elsewhere, still, parts[0].acceleration)], 10.02)
    residual = line.compare(sample(10.04, commanded=elsewhere))
    assert residual is not None
    assert residual.sigmas < 1


def test_without_a_plan_nothing_is_said() -> None:
    line = PlanLine(NUMBERS)
    assert line.compare(sample(3.0)) is None
    line.append(segments(), 10.0)
    line.drop()
    assert line.compare(sample(10.1)) is None
    assert line.sent_s > 1.0
