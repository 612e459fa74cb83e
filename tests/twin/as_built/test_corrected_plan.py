"""A motion through the correction is a motion: its rates are the slopes, its segments arrive."""

import numpy as np
import pytest

from twin.as_built import CorrectedPlan, JointCorrection, PlanarAsBuilt
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import alpha
from twin.motion import MotionLimits, plan_joint_move, plan_segments

DRAWN = RobotGeometry()
BUILT = PlanarAsBuilt.from_vector(
    PlanarAsBuilt.as_drawn(DRAWN).vector
    + np.array([2.5, -1.5, 1.0, 2.0, -2.5, -1.0, 0.008, -0.006, 0.004, -0.005])
)
PLAN = plan_joint_move(
    MotionLimits(), JointPosition(120.0, 180.0, 60.0), JointPosition(310.0, 90.0, 140.0)
)
CORRECTED = CorrectedPlan(PLAN, JointCorrection(DRAWN, BUILT))


def test_velocity_and_acceleration_are_the_slopes() -> None:
    times = np.linspace(0.1, PLAN.duration_s - 0.1, 37)
    here = CORRECTED.sample(times)
    ahead, behind = CORRECTED.sample(times + 1e-4), CORRECTED.sample(times - 1e-4)
    np.testing.assert_allclose(
        here.velocity_mm_s, (ahead.position_mm - behind.position_mm) / 2e-4, atol=1e-3
    )
    np.testing.assert_allclose(
        here.acceleration_mm_s2, (ahead.velocity_mm_s - behind.velocity_mm_s) / 2e-4, atol=0.5
    )


def test_one_time_is_as_many() -> None:
    many = CORRECTED.sample(np.array([0.7]))
    state = CORRECTED.state_at(0.7)
    np.testing.assert_allclose(state.position, many.position_mm[0], atol=1e-12)
    np.testing.assert_allclose(state.velocity, many.velocity_mm_s[0], atol=1e-12)
    np.testing.assert_allclose(state.acceleration, many.acceleration_mm_s2[0], atol=1e-9)
    assert CORRECTED.position_at(0.7) == state.position
    assert CORRECTED.velocity_at(0.7) == state.velocity
    assert CORRECTED.acceleration_at(0.7) == state.acceleration


def test_it_begins_and_ends_at_rest() -> None:
    for state in (CORRECTED.start, CORRECTED.end):
        assert state.velocity == pytest.approx((0, 0, 0), abs=1e-9)


def test_its_segments_keep_the_built_platform_on_the_drawn_way() -> None:
    segments = plan_segments(CORRECTED)
    assert len(segments) == len(plan_segments(PLAN))
    t_s = 0.0
    for segment in segments:
        t_s += segment.duration_s
        wanted = alpha.forward_many(DRAWN, np.array(PLAN.position_at(t_s)[:2]))
        reached = BUILT.forward_many(np.array(segment.end[:2]))
        assert np.linalg.norm(reached - wanted) < 0.05
    np.testing.assert_allclose(segments[-1].end, CORRECTED.end.position, atol=1e-9)
