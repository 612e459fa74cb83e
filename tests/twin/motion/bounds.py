"""Measuring whether a plan keeps its promises."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from twin.motion import MotionLimits, MotionPlan

SLACK = 1 + 1e-6
"""Room for rounding in the comparisons with limits."""


def limit_arrays(limits: MotionLimits) -> tuple[NDArray[np.float64], ...]:
    """Speeds, accelerations and jerks of the three joints, each of shape (3,)."""
    joints = limits.joints
    return (
        np.array([joint.velocity_mm_s for joint in joints]),
        np.array([joint.acceleration_mm_s2 for joint in joints]),
        np.array([joint.jerk_mm_s3 for joint in joints]),
    )


def assert_within(plan: MotionPlan, limits: MotionLimits, count: int = 400) -> None:
    """No joint exceeds its speed, acceleration or mean jerk between samples."""
    times = np.linspace(0, plan.duration_s, count)
    samples = plan.sample(times)
    velocity, acceleration, jerk = limit_arrays(limits)
    assert np.all(np.abs(samples.velocity_mm_s) <= velocity * SLACK)
    assert np.all(np.abs(samples.acceleration_mm_s2) <= acceleration * SLACK)
    steps = np.abs(np.diff(samples.acceleration_mm_s2, axis=0))
    # rounding of the accelerations, divided by a short interval, is not jerk
    assert np.all(steps <= jerk * SLACK * times[1] + 1e-9 * acceleration)


def assert_derivatives_agree(plan: MotionPlan, count: int = 50) -> None:
    """Velocity and acceleration are the slopes of position and velocity."""
    step = min(1e-5, plan.duration_s / 10)
    times = np.linspace(step, plan.duration_s - step, count)
    before, at, after = (plan.sample(times + shift) for shift in (-step, 0.0, step))
    slope = (after.position_mm - before.position_mm) / (2 * step)
    np.testing.assert_allclose(slope, at.velocity_mm_s, atol=1e-5)
    slope = (after.velocity_mm_s - before.velocity_mm_s) / (2 * step)
    # a jump of the jerk inside the interval changes the mean by up to jerk x step
    np.testing.assert_allclose(slope, at.acceleration_mm_s2, atol=0.1)


def assert_sample_agrees(plan: MotionPlan) -> None:
    """The vectorised plan is the scalar plan, also before its start and after its end."""
    times = np.linspace(-0.1, plan.duration_s + 0.1, 23)
    samples = plan.sample(times)
    for row, t_s in enumerate(times.tolist()):
        state = plan.state_at(t_s)
        np.testing.assert_allclose(samples.position_mm[row], state.position, atol=1e-9)
        np.testing.assert_allclose(samples.velocity_mm_s[row], state.velocity, atol=1e-7)
        np.testing.assert_allclose(samples.acceleration_mm_s2[row], state.acceleration, atol=1e-5)
        assert plan.position_at(t_s) == state.position
        assert plan.velocity_at(t_s) == state.velocity
        assert plan.acceleration_at(t_s) == state.acceleration
