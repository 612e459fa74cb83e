"""The fastest way to a standstill."""

from __future__ import annotations

from twin.joints import JointPosition
from twin.motion.limits import MotionLimits
from twin.motion.plan import JointState
from twin.motion.point_to_point import JointPlan, require_finite
from twin.motion.trajectory import solve_stop


def plan_stop(limits: MotionLimits, state: JointState) -> JointPlan:
    """Fastest jerk-limited stop, each joint by itself.

    The joints do not wait for each other, so the tip may leave the line it was on, by less than
    its stopping distance. A motion of rho3 alone stays on its line.

    Raises:
        InvalidMotionError: a number is not finite.
        PlanningError: no trajectory was found.
    """
    require_finite(state, state.position)
    trajectory = solve_stop(limits.joints, state.position, state.velocity, state.acceleration)
    standstill = JointPosition(*trajectory.at_time(trajectory.duration)[0])
    return JointPlan(trajectory.duration, state, JointState.at_rest(standstill), trajectory)
