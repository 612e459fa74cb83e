"""How the simulated board finds its limit switches.

The slide goes first, so that the plug is drawn back before anything moves sideways. On the rail
both carriages at the start of their strokes at once is no pose of the robot: the legs could not
close. So while one carriage seeks its switch the other runs away at the same speed, which moves
the platform along the rail at constant height. That height is chosen beforehand, from the stored
positions, by bringing rho1 + rho2 to ``carriage_sum_mm``. Homing ends with the platform over the
middle of the rail and the slide drawn back.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable

from drivers.robot import BoardRefusedError, BoardState, FaultCode
from drivers.simulator.board import SimulatedBoard
from drivers.simulator.segment_check import JOINTS
from drivers.simulator.set_points import STILL
from twin.joints import JointAcceleration, JointPosition
from twin.motion.segments import Segment

TOWARDS_SWITCH = ((-1.0, 1.0, 0.0), (1.0, -1.0, 0.0), (0.0, 0.0, -1.0))
"""Directions in which each joint seeks its switch."""

BEYOND_TRAVEL_MM = 20.0
"""Room for wrong stored positions: a switch further beyond the stroke than this is missing."""


def trapezoid(
    start: JointPosition,
    direction: tuple[float, float, float],
    distance_mm: float,
    speed_mm_s: float,
    acceleration_mm_s2: float,
) -> list[Segment]:
    """Accelerate, cruise and brake from rest to rest along a straight line of joint space.

    Args:
        start: Where the motion begins.
        direction: Joints per unit of distance.
        distance_mm: How far, not negative.
        speed_mm_s: Cruising speed, not reached if the way is too short.
        acceleration_mm_s2: Of both ramps.
    """
    speed = min(speed_mm_s, (distance_mm * acceleration_mm_s2) ** 0.5)
    if speed <= 0:
        return []
    ramp_s = speed / acceleration_mm_s2
    cruise_s = distance_mm / speed - ramp_s
    segments: list[Segment] = []
    position, velocity = start, STILL
    for duration_s, acceleration in (
        (ramp_s, acceleration_mm_s2),
        (cruise_s, 0.0),
        (ramp_s, -acceleration_mm_s2),
    ):
        if duration_s > 0:
            rates = JointAcceleration(*(d * acceleration for d in direction))
            segment = Segment(duration_s, position, velocity, rates)
            segments.append(segment)
            position, velocity = segment.end, segment.end_velocity
    return segments


class HomingRoutine:
    """One run of the homing routine.

    Args:
        board: In the state HOMING, at rest.
    """

    def __init__(self, board: SimulatedBoard) -> None:
        self._board = board
        self._world = board.world
        self._numbers = board.world.parameters.homing
        self._period_s = board.world.parameters.board.moving_period_s

    async def run(self) -> None:
        """Home all joints.

        Raises:
            BoardRefusedError: a stop or a fault ended it; the positions stay unknown.
        """
        await self._seek(2)
        await self._choose_height()
        await self._seek(0)
        await self._seek(1)
        target = self._world.homed_joints
        await self._go_to(target._replace(rho3_mm=self._here().rho3_mm))
        await self._go_to(target)
        self._board.end_homing()

    async def _seek(self, joint: int) -> None:
        """Find the switch fast, leave it, find it again slowly, and take its place as zero."""
        numbers = self._numbers
        direction = TOWARDS_SWITCH[joint]
        travel = self._world.geometry.joint_ranges[joint]
        furthest_mm = travel.stroke_mm + BEYOND_TRAVEL_MM
        await self._find_switch(joint, direction, furthest_mm, self._speed(joint))
        await self._leave_switch(joint, direction)
        furthest_mm = BEYOND_TRAVEL_MM + numbers.back_off_mm
        await self._find_switch(joint, direction, furthest_mm, numbers.locate_speed_mm_s)
        now_s = self._now()
        error_mm = float(self._world.streams.homing.normal(0.0, numbers.repeatability_std_mm))
        # the switch sees the carriage, so play and assembly errors of the drive drop out
        found_mm = self._board.sync(now_s).carriages[joint] + error_mm
        self._world.renumber(joint, found_mm, now_s)

    async def _find_switch(
        self,
        joint: int,
        direction: tuple[float, float, float],
        furthest_mm: float,
        speed_mm_s: float,
    ) -> None:
        self._start(direction, furthest_mm, speed_mm_s)
        await self._until(lambda: self._pressed(joint) or self._at_rest())
        if not self._pressed(joint):
            self._fail(f"The limit switch of {JOINTS[joint]} was not found.")
        self._world.brake(self._now())
        await self._until(self._at_rest)

    async def _leave_switch(self, joint: int, direction: tuple[float, float, float]) -> None:
        """Go back until the switch opens, and a little further."""
        back = (-direction[0], -direction[1], -direction[2])
        self._start(back, BEYOND_TRAVEL_MM, self._speed(joint))
        await self._until(lambda: not self._pressed(joint) or self._at_rest())
        if self._pressed(joint):
            self._fail(f"The limit switch of {JOINTS[joint]} does not open; look for a cut wire.")
        self._world.brake(self._now())
        await self._until(self._at_rest)
        self._start(back, self._numbers.back_off_mm, self._speed(joint))
        await self._until(self._at_rest)

    async def _choose_height(self) -> None:
        """Bring rho1 + rho2 to the chosen sum, along the rail no further than necessary."""
        here = self._here()
        total_mm = self._numbers.carriage_sum_mm
        rho1_mm = 0.5 * (total_mm + here.rho1_mm - here.rho2_mm)
        rho1_mm = min(max(rho1_mm, BEYOND_TRAVEL_MM), total_mm - BEYOND_TRAVEL_MM)
        await self._go_to(here._replace(rho1_mm=rho1_mm, rho2_mm=total_mm - rho1_mm))

    async def _go_to(self, target: JointPosition) -> None:
        """A straight line in joint space, as fast as its slowest joint allows."""
        way = [t - h for t, h in zip(target, self._here(), strict=True)]
        distance_mm = max(abs(w) for w in way)
        if distance_mm == 0:
            return
        moving = [joint for joint in range(3) if abs(way[joint]) > 1e-6]
        speed_mm_s = min((self._speed(joint) for joint in moving), default=self._speed(2))
        direction = (way[0] / distance_mm, way[1] / distance_mm, way[2] / distance_mm)
        self._start(direction, distance_mm, speed_mm_s)
        await self._until(self._at_rest)

    def _start(
        self, direction: tuple[float, float, float], distance_mm: float, speed_mm_s: float
    ) -> None:
        self._require_homing()
        acceleration = min(
            self._numbers.acceleration_mm_s2,
            *(
                limits.acceleration_mm_s2
                for limits, d in zip(self._world.limits.joints, direction, strict=True)
                if d
            ),
        )
        segments = trapezoid(self._here(), direction, distance_mm, speed_mm_s, acceleration)
        if segments:
            self._world.follow(segments, self._now())

    async def _until(self, condition: Callable[[], bool]) -> None:
        while True:
            self._board.sync(self._now())
            self._require_homing()
            if condition():
                return
            await asyncio.sleep(self._period_s)

    def _require_homing(self) -> None:
        """Nothing moves any more once a stop or a fault has ended the routine."""
        if self._board.state is not BoardState.HOMING:
            fault = self._board.fault
            raise BoardRefusedError(
                f"Homing was ended by a fault: {fault.detail}"
                if fault
                else "Homing was stopped before it was done."
            )

    def _fail(self, detail: str) -> None:
        self._board.latch(FaultCode.HOMING_FAILED, detail, self._now())
        raise BoardRefusedError(f"Homing failed: {detail}")

    def _speed(self, joint: int) -> float:
        numbers = self._numbers
        wanted = numbers.slide_speed_mm_s if joint == 2 else numbers.rail_speed_mm_s
        return min(wanted, self._world.limits.joints[joint].velocity_mm_s)

    def _at_rest(self) -> bool:
        return not self._board.moving

    def _pressed(self, joint: int) -> bool:
        return self._board.pressed_switches(self._world.advance(self._now()))[joint]

    def _here(self) -> JointPosition:
        return self._world.line.at(self._now()).position

    @staticmethod
    def _now() -> float:
        return asyncio.get_running_loop().time()
