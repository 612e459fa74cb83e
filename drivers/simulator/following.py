"""Hardware in the loop: a simulated world whose motors are not simulated.

The world's own motors then only stand where motors elsewhere stand; behind them everything is as
ever: play, errors of the build, sag, the plug in its socket, what the camera sees.
"""

from __future__ import annotations

from collections.abc import Iterator

from drivers.robot import RobotState
from drivers.simulator.parameters import SimulationParameters
from drivers.simulator.set_points import UNACCELERATED
from drivers.simulator.world import SimulatedWorld
from twin.joints import JointPosition, JointVelocity
from twin.motion.segments import Segment

NO_LAG_S = 1e-6
"""Motors elsewhere lag behind their set points by themselves, ..."""

NO_LIMIT_N = 1e5
"""... and have a limit of force of their own."""

SPEED_MARGIN = 1.5
"""Drives are not faster than this times their limits, ..."""

ROUNDING_MM = 0.5
"""... and two samples need not be taken exactly when they say."""


def without_motors(
    parameters: SimulationParameters, start: JointPosition | None = None
) -> SimulationParameters:
    """Parameters of a world whose motors are elsewhere.

    Args:
        parameters: Of a world with motors.
        start: Where those motors stand at first; None takes the place of the parameters.
    """
    return parameters.model_copy(
        update={
            "drives": parameters.drives.model_copy(update={"lag_s": NO_LAG_S}),
            "homing": parameters.homing.model_copy(update={"power_off_creep_std_mm": 0.0}),
            "board": parameters.board.model_copy(
                update={"start_joints": start or parameters.board.start_joints}
            ),
        }
    )


class FollowedMotors:
    """The motors of a world, led along by motors elsewhere.

    Args:
        world: Made with the parameters of ``without_motors``; nobody else moves its motors.
    """

    def __init__(self, world: SimulatedWorld) -> None:
        self._world = world
        world.set_force_limit(NO_LIMIT_N, world.now_s)

    @property
    def position(self) -> JointPosition:
        """Where they were led last."""
        return self._world.line.queue_end(self._world.now_s)[1]

    def move(self, position: JointPosition, at_s: float) -> None:
        """Come to a position at a time, in a straight line from the last one.

        Left out when somebody has asked the world about a later time already; the next one makes
        up for it.

        Args:
            position: In the board's coordinates.
            at_s: When they stood there, in the time of the world.
        """
        world = self._world
        start_s, start, _ = world.line.queue_end(world.now_s)
        elapsed_s = at_s - start_s
        if elapsed_s <= 0:
            return
        if position != start or world.line.rests_from_s > start_s:
            velocity = JointVelocity(
                *((q - p) / elapsed_s for q, p in zip(position, start, strict=True))
            )
            world.follow([Segment(elapsed_s, start, velocity, UNACCELERATED)], start_s)
        world.advance(at_s)

    def jump(self, position: JointPosition, at_s: float) -> None:
        """Stand somewhere else without having moved there."""
        self._world.drive_to(position, max(at_s, self._world.now_s))


class RobotFollower:
    """Lets the motors of a world follow the telemetry of a robot.

    - The board remembers where it came to rest before it lost its power, and takes the robot to
      stand there still. So does this: the first sample is believed.
    - As long as the robot is not homed its positions may be wrong, but they change truly. So only
      their changes count. A change that no drive could make is another numbering, as when homing
      has found a switch, and moves nothing.
    - Once it is homed its positions are where it stands. If it was believed to stand elsewhere it
      jumps there.

    Args:
        world: Made with the parameters of ``without_motors``; nobody else moves its motors.
    """

    def __init__(self, world: SimulatedWorld) -> None:
        self._motors = FollowedMotors(world)
        self._speeds_mm_s = [limit.velocity_mm_s for limit in world.limits.joints]
        self._last: RobotState | None = None
        self._shift_mm = JointPosition(0.0, 0.0, 0.0)

    def take(self, state: RobotState) -> None:
        """Take in a sample; one that is not newer than the last changes nothing."""
        last, reported, at_s = self._last, state.measured.position, state.sampled_at_s
        if last is None:
            self._last = state
            self._motors.jump(reported, at_s)
            return
        elapsed_s = at_s - last.sampled_at_s
        if elapsed_s <= 0:
            return
        self._last = state
        if state.homed:
            self._shift_mm = JointPosition(0.0, 0.0, 0.0)
            if all(self._can_move(self._motors.position, reported, elapsed_s)):
                self._motors.move(reported, at_s)
            else:
                self._motors.jump(reported, at_s)
            return
        before = last.measured.position
        moved = self._can_move(before, reported, elapsed_s)
        self._shift_mm = JointPosition(
            *(
                shift if real else shift - (q - p)
                for shift, real, q, p in zip(self._shift_mm, moved, reported, before, strict=True)
            )
        )
        standing = JointPosition(*(q + s for q, s in zip(reported, self._shift_mm, strict=True)))
        self._motors.move(standing, at_s)

    def _can_move(
        self, start: JointPosition, end: JointPosition, elapsed_s: float
    ) -> Iterator[bool]:
        """For each joint, whether its drive can go that far in that time."""
        for p, q, speed_mm_s in zip(start, end, self._speeds_mm_s, strict=True):
            yield abs(q - p) <= SPEED_MARGIN * speed_mm_s * elapsed_s + ROUNDING_MM
