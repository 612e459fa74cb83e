"""A joint move whose carriages both come to their target from below, so that play is taken up."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from twin.joints import JointPosition
from twin.motion.limits import MotionLimits
from twin.motion.plan import Array, JointState, MotionPlan, MotionSamples, ReadByState
from twin.motion.point_to_point import JointPlan, plan_joint_move, require_finite
from twin.motion.trajectory import solve_freely

CARRIAGES = 2
_STEP_MM = 0.005
"""A carriage that goes back by less than a step of its motor has not turned back."""


@dataclass(frozen=True, slots=True)
class TurningPlan(ReadByState):
    """One plan until ``turn_s``, then another, which begins in the state that the first has then.

    Attributes:
        first: Followed up to the turn.
        turn_s: When it is left [s].
        second: Followed from there to its end.
    """

    first: MotionPlan
    turn_s: float
    second: MotionPlan

    @property
    def duration_s(self) -> float:
        """Of both parts [s]."""
        return self.turn_s + self.second.duration_s

    @property
    def start(self) -> JointState:
        """State at time 0, possibly in motion."""
        return self.first.start

    @property
    def end(self) -> JointState:
        """At rest."""
        return self.second.end

    def state_at(self, t_s: float) -> JointState:
        """Positions, velocities and accelerations t_s seconds after the start."""
        if t_s < self.turn_s:
            return self.first.state_at(t_s)
        return self.second.state_at(t_s - self.turn_s)

    def sample(self, times_s: Array) -> MotionSamples:
        """The plan at many times, shape (N,) [s]."""
        states = [self.state_at(t_s) for t_s in times_s.tolist()]
        position, velocity, acceleration = (
            np.array(rows, dtype=np.float64).reshape(-1, 3)
            for rows in (
                [state.position for state in states],
                [state.velocity for state in states],
                [state.acceleration for state in states],
            )
        )
        return MotionSamples(position, velocity, acceleration)


def plan_from_below(
    limits: MotionLimits,
    start: JointState | JointPosition,
    target: JointPosition,
    below: JointPosition,
    *,
    taken_up: bool,
) -> MotionPlan:
    """Fast motion to rest at a target that both carriages reach from below.

    Where the direct way brings both up to it, that one. Else the carriages go below the target
    first, while the slide is on its whole way already; it does not wait for them.

    Args:
        limits: Of the joints.
        start: State at the beginning, possibly in motion.
        target: Where to come to rest.
        below: Whence the carriages come; no further up than the target.
        taken_up: Before this motion they came from below already.

    Raises:
        InvalidMotionError: a number is not finite.
        PlanningError: no trajectory was found.
    """
    if not isinstance(start, JointState):
        start = JointState.at_rest(start)
    direct = plan_joint_move(limits, start, target)
    if _rises(direct, below, taken_up=taken_up):
        return direct
    via = target._replace(rho1_mm=below.rho1_mm, rho2_mm=below.rho2_mm)
    require_finite(start, via)
    down = solve_freely(limits.joints, start.position, start.velocity, start.acceleration, via)
    turn_s = max(down.independent_min_durations[:CARRIAGES])
    first = JointPlan(down.duration, start, JointState.at_rest(via), down)
    at_turn = first.state_at(turn_s)
    return TurningPlan(first, turn_s, plan_joint_move(limits, at_turn, target))


def _rises(plan: JointPlan, below: JointPosition, *, taken_up: bool) -> bool:
    """Whether both carriages only go up, and far enough to have come from below at its end."""
    start, end = plan.start.position, plan.end.position
    for joint, seen in enumerate(plan.trajectory.position_extrema[:CARRIAGES]):
        turns = seen.min < start[joint] - _STEP_MM or seen.max > end[joint] + _STEP_MM
        moving = plan.start.velocity[joint] > 0
        if turns or not (taken_up or moving or start[joint] <= below[joint]):
            return False
    return True
