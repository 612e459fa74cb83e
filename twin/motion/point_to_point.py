"""Fastest joint motion to a target: every joint on its own time-optimal profile."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from twin.joints import JointAcceleration, JointPosition, JointVelocity
from twin.motion.errors import InvalidMotionError
from twin.motion.limits import MotionLimits
from twin.motion.plan import Array, JointState, MotionSamples, ReadByState
from twin.motion.trajectory import Trajectory, solve_position


@dataclass(frozen=True, slots=True)
class JointPlan(ReadByState):
    """A plan whose joints follow piecewise cubic profiles."""

    duration_s: float
    start: JointState
    end: JointState
    trajectory: Trajectory

    def state_at(self, t_s: float) -> JointState:
        """Positions, velocities and accelerations t_s seconds after the start."""
        if t_s <= 0:
            return self.start
        if t_s >= self.duration_s:
            return self.end
        position, velocity, acceleration = self.trajectory.at_time(t_s)
        return JointState(
            JointPosition(*position), JointVelocity(*velocity), JointAcceleration(*acceleration)
        )

    def sample(self, times_s: Array) -> MotionSamples:
        """The plan at many times, shape (N,) [s]."""
        at_time = self.trajectory.at_time
        clipped = np.clip(times_s, 0.0, self.duration_s).tolist()
        samples = np.array([at_time(t_s) for t_s in clipped]).reshape(-1, 3, 3)
        return MotionSamples(samples[:, 0], samples[:, 1], samples[:, 2])


def plan_joint_move(
    limits: MotionLimits, start: JointState | JointPosition, target: JointPosition
) -> JointPlan:
    """Fastest synchronised motion to rest at a target.

    The start may be in motion, so that a motion can be given a new target on its way. A start
    state above the limits (after a change to a slower speed) is first brought back below them.
    The plan knows no joint ranges: `check_plan` does.

    Raises:
        InvalidMotionError: a number is not finite.
        PlanningError: no trajectory was found.
    """
    if not isinstance(start, JointState):
        start = JointState.at_rest(start)
    require_finite(start, target)
    trajectory = solve_position(
        limits.joints, start.position, start.velocity, start.acceleration, target
    )
    return JointPlan(trajectory.duration, start, JointState.at_rest(target), trajectory)


def minimum_time_s(
    limits: MotionLimits, start: JointState | JointPosition, target: JointPosition
) -> float:
    """Duration of the fastest synchronised motion to rest at a target [s].

    Raises:
        InvalidMotionError: a number is not finite.
        PlanningError: no trajectory was found.
    """
    return plan_joint_move(limits, start, target).duration_s


def require_finite(start: JointState, target: JointPosition) -> None:
    """Do nothing if all numbers are finite.

    Raises:
        InvalidMotionError: one is not.
    """
    numbers = (*start.position, *start.velocity, *start.acceleration, *target)
    if not all(map(math.isfinite, numbers)):
        msg = f"a motion from {start} to {target} has numbers that are not finite"
        raise InvalidMotionError(msg)
