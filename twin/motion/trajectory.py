"""Time-optimal jerk-limited trajectories, computed by the ruckig library.

L. Berscheid, T. Kroeger, "Jerk-limited Real-time Trajectory Generation with Arbitrary Target
States", Robotics: Science and Systems 2021.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Protocol

from ruckig import (
    ControlInterface,
    InputParameter,
    Ruckig,
    RuckigError,
    Synchronization,
)
from ruckig import Trajectory as RuckigTrajectory

from twin.motion.errors import PlanningError
from twin.motion.limits import JointLimits


class AxisLimits(NamedTuple):
    """Limits of one degree of freedom that is not a joint."""

    velocity_mm_s: float
    acceleration_mm_s2: float
    jerk_mm_s3: float


class Extrema(Protocol):
    """How far one degree of freedom goes."""

    @property
    def min(self) -> float:
        """Least position."""
        ...

    @property
    def max(self) -> float:
        """Largest position."""
        ...


class Trajectory(Protocol):
    """A computed trajectory of one or more degrees of freedom."""

    @property
    def duration(self) -> float:
        """Length [s]."""
        ...

    @property
    def independent_min_durations(self) -> list[float]:
        """When each degree of freedom could arrive by itself [s]."""
        ...

    @property
    def position_extrema(self) -> Sequence[Extrema]:
        """How far each degree of freedom goes."""
        ...

    def at_time(self, time: float, /) -> tuple[list[float], list[float], list[float]]:
        """Positions, velocities and accelerations at a time."""
        ...


LIMIT_FRACTIONS = (1.0, 1.0 - 1e-6, 1.0 - 1e-3, 0.97)
"""Tried in turn. Start states that sit exactly on a limit are numerically delicate; a little
less of all limits moves the solution away from them and leaves the start state as it is."""


def solve_position(
    limits: Sequence[JointLimits | AxisLimits],
    position: Sequence[float],
    velocity: Sequence[float],
    acceleration: Sequence[float],
    target: Sequence[float],
) -> Trajectory:
    """Fastest motion of all joints to rest at a target, arriving at the same time.

    A start state above a limit is first brought back below it, as fast as the jerk allows.

    Raises:
        PlanningError: no trajectory was found.
    """
    problem = _problem(limits, position, velocity, acceleration)
    problem.target_position = list(target)
    return _solve(problem, limits)


def solve_freely(
    limits: Sequence[JointLimits | AxisLimits],
    position: Sequence[float],
    velocity: Sequence[float],
    acceleration: Sequence[float],
    target: Sequence[float],
) -> Trajectory:
    """Fastest motion of each joint to rest at its target, none waiting for another.

    Raises:
        PlanningError: no trajectory was found.
    """
    problem = _problem(limits, position, velocity, acceleration)
    problem.target_position = list(target)
    problem.synchronization = Synchronization.No
    return _solve(problem, limits)


def solve_stop(
    limits: Sequence[JointLimits | AxisLimits],
    position: Sequence[float],
    velocity: Sequence[float],
    acceleration: Sequence[float],
) -> Trajectory:
    """Fastest motion of each joint to rest, wherever that is.

    Raises:
        PlanningError: no trajectory was found.
    """
    problem = _problem(limits, position, velocity, acceleration)
    problem.control_interface = ControlInterface.Velocity
    problem.synchronization = Synchronization.No
    return _solve(problem, limits)


def _problem(
    limits: Sequence[JointLimits | AxisLimits],
    position: Sequence[float],
    velocity: Sequence[float],
    acceleration: Sequence[float],
) -> InputParameter:
    problem = InputParameter(len(limits))
    problem.current_position = list(position)
    problem.current_velocity = list(velocity)
    problem.current_acceleration = list(acceleration)
    return problem


def _solve(problem: InputParameter, limits: Sequence[JointLimits | AxisLimits]) -> Trajectory:
    solver = Ruckig(len(limits))
    trajectory: Trajectory = RuckigTrajectory(len(limits))
    failure: RuckigError | None = None
    for fraction in LIMIT_FRACTIONS:
        problem.max_velocity = [axis.velocity_mm_s * fraction for axis in limits]
        problem.max_acceleration = [axis.acceleration_mm_s2 * fraction for axis in limits]
        problem.max_jerk = [axis.jerk_mm_s3 * fraction for axis in limits]
        try:
            solver.calculate(problem, trajectory)
        except RuckigError as error:
            failure = error
        else:
            return trajectory
    msg = (
        f"no motion was found for joints at {problem.current_position} mm that move at "
        f"{problem.current_velocity} mm/s"
    )
    raise PlanningError(msg) from failure
