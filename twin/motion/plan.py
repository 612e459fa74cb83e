"""What a planned motion is: joint positions, velocities and accelerations as functions of time."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Protocol, Self

import numpy as np
from numpy.typing import NDArray

from twin.joints import JointAcceleration, JointPosition, JointVelocity

Array = NDArray[np.float64]

NO_VELOCITY = JointVelocity(0.0, 0.0, 0.0)
NO_ACCELERATION = JointAcceleration(0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class JointState:
    """Joint positions with their first two derivatives at one instant."""

    position: JointPosition
    velocity: JointVelocity = NO_VELOCITY
    acceleration: JointAcceleration = NO_ACCELERATION

    @classmethod
    def at_rest(cls, position: JointPosition) -> Self:
        """The state of a robot that stands still."""
        return cls(position)


@dataclass(frozen=True, slots=True)
class MotionSamples:
    """A plan at many times; all arrays have the joints in their columns, shape (N, 3)."""

    position_mm: Array
    velocity_mm_s: Array
    acceleration_mm_s2: Array


class MotionPlan(Protocol):
    """A motion of all joints that begins at time 0 and lasts `duration_s`.

    Before 0 a plan stays at its start, after `duration_s` at its end.
    """

    @property
    def duration_s(self) -> float:
        """Length of the motion [s], 0 if there is nothing to move."""
        ...

    @property
    def start(self) -> JointState:
        """State at time 0, possibly in motion."""
        ...

    @property
    def end(self) -> JointState:
        """State at `duration_s`."""
        ...

    def state_at(self, t_s: float) -> JointState:
        """Positions, velocities and accelerations t_s seconds after the start."""
        ...

    def position_at(self, t_s: float) -> JointPosition:
        """Joint positions t_s seconds after the start [mm]."""
        ...

    def velocity_at(self, t_s: float) -> JointVelocity:
        """Joint velocities t_s seconds after the start [mm/s]."""
        ...

    def acceleration_at(self, t_s: float) -> JointAcceleration:
        """Joint accelerations t_s seconds after the start [mm/s^2]."""
        ...

    def sample(self, times_s: Array) -> MotionSamples:
        """The plan at many times, shape (N,) [s]."""
        ...


class ReadByState(ABC):
    """Gives a plan its positions, velocities and accelerations from its states."""

    __slots__ = ()

    @abstractmethod
    def state_at(self, t_s: float) -> JointState:
        """Positions, velocities and accelerations t_s seconds after the start."""

    def position_at(self, t_s: float) -> JointPosition:
        """Joint positions t_s seconds after the start [mm]."""
        return self.state_at(t_s).position

    def velocity_at(self, t_s: float) -> JointVelocity:
        """Joint velocities t_s seconds after the start [mm/s]."""
        return self.state_at(t_s).velocity

    def acceleration_at(self, t_s: float) -> JointAcceleration:
        """Joint accelerations t_s seconds after the start [mm/s^2]."""
        return self.state_at(t_s).acceleration
