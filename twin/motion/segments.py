"""Constant-acceleration segments: the form in which a plan is sent to a motion board."""

from __future__ import annotations

from dataclasses import dataclass

from twin.joints import JointAcceleration, JointPosition, JointVelocity


@dataclass(frozen=True, slots=True)
class Segment:
    """Motion of all joints with constant acceleration for a given time.

    q(t) = start + velocity t + acceleration t^2 / 2 for 0 <= t <= duration_s.
    """

    duration_s: float
    start: JointPosition
    velocity: JointVelocity
    acceleration: JointAcceleration

    def position_at(self, t_s: float) -> JointPosition:
        """Joint positions t_s seconds after the start [mm]."""
        half = 0.5 * t_s * t_s
        return JointPosition(
            *(
                q + v * t_s + a * half
                for q, v, a in zip(self.start, self.velocity, self.acceleration, strict=True)
            )
        )

    def velocity_at(self, t_s: float) -> JointVelocity:
        """Joint velocities t_s seconds after the start [mm/s]."""
        return JointVelocity(
            *(v + a * t_s for v, a in zip(self.velocity, self.acceleration, strict=True))
        )

    @property
    def end(self) -> JointPosition:
        """Joint positions at the end of the segment [mm]."""
        return self.position_at(self.duration_s)

    @property
    def end_velocity(self) -> JointVelocity:
        """Joint velocities at the end of the segment [mm/s]."""
        return self.velocity_at(self.duration_s)
