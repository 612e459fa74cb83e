"""From a plan to the constant-acceleration segments that a motion board follows."""

from __future__ import annotations

import math

import numpy as np

from twin.joints import JointAcceleration, JointPosition, JointVelocity
from twin.motion.errors import InvalidMotionError
from twin.motion.plan import MotionPlan
from twin.motion.segments import Segment

LEAST_SEGMENTS = 2
"""One segment alone could not begin and end at rest, nor absorb the residual."""


def plan_segments(plan: MotionPlan, segment_s: float = 0.02) -> list[Segment]:
    """Segments of equal duration, at most segment_s long, that together make the plan.

    The knots divide the plan exactly. Their velocities are the plan's own, so the segments are
    the trapezoidal integral of the plan's velocity: continuous in position and velocity. What
    the trapezoids miss at the end is put back by a velocity bump proportional to sin^2, which is
    smooth and zero at both ends. By the Euler-Maclaurin formula they miss
    dt^2/12 (acceleration(end) - acceleration(start)): nothing to speak of from rest to rest. On
    the way the segments stay within segment_s^2 / 4 times the largest acceleration from the plan,
    0.04 mm at 400 mm/s^2 and 0.02 s.

    Args:
        plan: The motion; it may start in motion.
        segment_s: Longest duration of a segment [s].

    Returns:
        The segments in order; none for a plan that takes no time.

    Raises:
        InvalidMotionError: segment_s is not greater than zero.
    """
    if not segment_s > 0:
        msg = f"the duration of a segment must be greater than zero, not {segment_s:g} s"
        raise InvalidMotionError(msg, {"segment_s": segment_s})
    if plan.duration_s <= 0:
        return []
    # a plan of exactly n segments must not get one more through rounding
    count = max(LEAST_SEGMENTS, math.ceil(plan.duration_s / segment_s - 1e-9))
    dt_s = plan.duration_s / count
    velocity = plan.sample(np.linspace(0.0, plan.duration_s, count + 1)).velocity_mm_s
    velocity[0], velocity[-1] = plan.start.velocity, plan.end.velocity
    displacement = np.subtract(plan.end.position, plan.start.position)
    travelled = 0.5 * dt_s * (velocity[:-1] + velocity[1:]).sum(axis=0)
    # the sum of sin^2(pi k / n) over k is n/2, so this bump covers exactly the residual
    bump = np.sin(np.pi * np.arange(1, count) / count) ** 2
    velocity[1:-1] += np.outer(bump, 2.0 * (displacement - travelled) / plan.duration_s)
    acceleration = np.diff(velocity, axis=0) / dt_s
    steps = np.cumsum(0.5 * dt_s * (velocity[:-1] + velocity[1:]), axis=0)
    position = np.vstack((plan.start.position, np.asarray(plan.start.position) + steps))
    return [
        Segment(dt_s, JointPosition(*q), JointVelocity(*v), JointAcceleration(*a))
        for q, v, a in zip(
            position[:-1].tolist(), velocity[:-1].tolist(), acceleration.tolist(), strict=True
        )
    ]
