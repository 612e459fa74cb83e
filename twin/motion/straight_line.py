"""Motion of the plug tip on an exact straight line, from rest to rest."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from twin.geometry import RobotGeometry
from twin.joints import JointAcceleration, JointPosition, JointVelocity, TipPosition
from twin.kinematics import gamma
from twin.motion.errors import InvalidMotionError
from twin.motion.limits import MotionLimits
from twin.motion.path_limits import LARGEST, path_limits
from twin.motion.plan import Array, JointState, MotionSamples, ReadByState
from twin.motion.tip_line import TipLine
from twin.motion.trajectory import Trajectory, solve_position


@dataclass(frozen=True, slots=True)
class StraightLinePlan(ReadByState):
    """A plan whose tip follows a line; the trajectory is the distance along it."""

    duration_s: float
    start: JointState
    end: JointState
    line: TipLine
    trajectory: Trajectory

    def state_at(self, t_s: float) -> JointState:
        """Positions, velocities and accelerations t_s seconds after the start."""
        if t_s <= 0:
            return self.start
        if t_s >= self.duration_s:
            return self.end
        (distance,), (speed,), (gain,) = self.trajectory.at_time(t_s)
        slope, curve, _ = self.line.derivatives_at(distance)
        squared = speed * speed
        return JointState(
            self.line.joints_at(distance),
            JointVelocity(slope[0] * speed, slope[1] * speed, slope[2] * speed),
            JointAcceleration(
                slope[0] * gain + curve[0] * squared,
                slope[1] * gain + curve[1] * squared,
                slope[2] * gain + curve[2] * squared,
            ),
        )

    def sample(self, times_s: Array) -> MotionSamples:
        """The plan at many times, shape (N,) [s]."""
        at_time = self.trajectory.at_time
        clipped = np.clip(times_s, 0.0, self.duration_s).tolist()
        along = np.array([at_time(t_s) for t_s in clipped]).reshape(-1, 3, 1)
        distance, speed, gain = along[:, 0], along[:, 1], along[:, 2]
        position, slope, curve = self.line.sample(distance[:, 0])
        return MotionSamples(position, slope * speed, slope * gain + curve * speed * speed)


def plan_straight_line(
    geometry: RobotGeometry,
    limits: MotionLimits,
    start: JointPosition,
    target_tip: TipPosition,
    *,
    tip_speed_mm_s: float | None = None,
) -> StraightLinePlan:
    """Fast motion of the tip on a straight line, within the limits of every joint.

    Both ends are at rest. The target must be within the joint limits; whether the way there is,
    `check_plan` tells.

    Args:
        geometry: The robot.
        limits: Limits of the joints.
        start: Where the robot stands.
        target_tip: Where its tip shall go, in the base frame.
        tip_speed_mm_s: Largest speed of the tip on the line [mm/s], if it shall be limited.

    Raises:
        UnreachableError: the target is out of reach.
        LegsCannotCloseError: the start is no pose of the robot.
        InvalidMotionError: the speed is not greater than zero.
        PlanningError: at an end of the line no speed is possible.
    """
    if tip_speed_mm_s is not None and not (tip_speed_mm_s > 0 and math.isfinite(tip_speed_mm_s)):
        msg = f"the tip's speed must be greater than zero, not {tip_speed_mm_s:g} mm/s"
        raise InvalidMotionError(msg, {"tip_speed_mm_s": tip_speed_mm_s})
    target = gamma.inverse(geometry, target_tip)
    line = TipLine.between(geometry, start, target_tip)
    along = path_limits(
        limits, line.largest_derivatives(), line.length_mm, tip_speed_mm_s or LARGEST
    )
    trajectory = solve_position([along], [0.0], [0.0], [0.0], [line.length_mm])
    return StraightLinePlan(
        trajectory.duration, JointState.at_rest(start), JointState.at_rest(target), line, trajectory
    )
