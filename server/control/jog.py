"""Jogging: steps, and hold-to-move with a dead-man's lease."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Awaitable
from typing import Literal

from server.control.errors import ControlError, MotionOutOfReachError
from server.control.lease import Lease
from server.control.supervisor import Supervisor
from server.errors import PlugPilotError
from twin.errors import TwinError
from twin.geometry import RobotGeometry
from twin.joints import JointPosition, TipPosition
from twin.kinematics import KinematicsError, gamma
from twin.motion import JointLimits, MotionLimits, MotionPlan, plan_joint_move, plan_straight_line

_log = logging.getLogger(__name__)

Axis = Literal["rho1", "rho2", "rho3", "x", "y", "insertion"]

DEAD_MAN_S = 0.25
"""Silence after which a held button counts as released."""

LIMIT_MARGIN_MM = 0.5
SEARCH_STEP_MM = 5.0

_JOINT_OF = {"rho1": 0, "rho2": 1, "rho3": 2, "insertion": 2}


class Jog:
    """Moves one axis at a time for a person.

    Args:
        supervisor: Owner of the robot.
        dead_man_s: Silence after which a held button counts as released, in event loop time.
    """

    def __init__(self, supervisor: Supervisor, dead_man_s: float = DEAD_MAN_S) -> None:
        self._supervisor = supervisor
        self._dead_man_s = dead_man_s
        self._task: asyncio.Task[None] | None = None
        self._direction: tuple[Axis, int] | None = None
        self._deadline: asyncio.TimerHandle | None = None

    async def step(self, axis: Axis, distance_mm: float, speed_mm_s: float) -> None:
        """Move one axis by a distance; returns when it is there.

        Raises:
            ControlError: somebody else has control, or the robot may not or cannot go there.
        """
        async with self._supervisor.control("jog", "A technician") as lease:
            await self._supervisor.follow(lease, self._plan(axis, distance_mm, speed_mm_s))

    def hold(self, axis: Axis, direction: int, speed_mm_s: float) -> None:
        """The button is held: begin to move, or go on.

        Raises:
            ControlError: somebody else has control, or the robot may not or cannot go there.
        """
        if self._task is not None and not self._task.done():
            if self._direction != (axis, direction):
                self.release()
                return
            self._restart_timer()
            return
        lease = self._supervisor.acquire("jog", "A technician")
        try:
            distance_mm = direction * self._way_left_mm(axis, direction)
            plan = self._plan(axis, distance_mm, speed_mm_s)
            motion = self._supervisor.start_motion(lease, plan)
        except BaseException:
            self._supervisor.give_back(lease)
            raise
        self._direction = (axis, direction)
        self._task = asyncio.create_task(self._move(lease, self._supervisor.run(motion)))
        self._restart_timer()

    def release(self) -> None:
        """The button was released, or its owner has gone: stop now."""
        if self._deadline is not None:
            self._deadline.cancel()
            self._deadline = None
        if self._task is not None:
            self._task.cancel()

    async def wait_stopped(self) -> None:
        """Wait until the held motion has come to rest."""
        if self._task is not None:
            await asyncio.gather(self._task, return_exceptions=True)

    async def _move(self, lease: Lease, run: Awaitable[object]) -> None:
        try:
            await run
        except PlugPilotError as error:
            _log.warning("jogging ended: %s", error.detail)
        finally:
            self._supervisor.give_back(lease)

    def _restart_timer(self) -> None:
        if self._deadline is not None:
            self._deadline.cancel()
        loop = asyncio.get_running_loop()
        self._deadline = loop.call_later(self._dead_man_s, self.release)

    def _plan(self, axis: Axis, distance_mm: float, speed_mm_s: float) -> MotionPlan:
        supervisor = self._supervisor
        start = supervisor.telemetry.require().commanded.position
        try:
            if axis in _JOINT_OF:
                joint = _JOINT_OF[axis]
                target = JointPosition(
                    *(q + (distance_mm if i == joint else 0.0) for i, q in enumerate(start))
                )
                return plan_joint_move(_at_most(supervisor.limits, speed_mm_s), start, target)
            tip = _shifted(gamma.forward(supervisor.geometry, start), axis, distance_mm)
            return plan_straight_line(
                supervisor.geometry, supervisor.limits, start, tip, tip_speed_mm_s=speed_mm_s
            )
        except TwinError as error:
            raise MotionOutOfReachError(str(error)) from error

    def _way_left_mm(self, axis: Axis, direction: int) -> float:
        """How far the axis can go in a direction, less a margin [mm]."""
        supervisor = self._supervisor
        start = supervisor.telemetry.require().commanded.position
        if axis in _JOINT_OF:
            joint = _JOINT_OF[axis]
            travel = supervisor.geometry.joint_ranges[joint]
            end = travel.max_mm if direction > 0 else travel.min_mm
            way_mm = abs(end - start[joint]) - LIMIT_MARGIN_MM
        else:
            way_mm = _straight_way_mm(supervisor.geometry, start, axis, direction)
        if way_mm <= 0:
            raise MotionOutOfReachError(f"{axis} is at the end of its travel.", axis=axis)
        return way_mm


def _straight_way_mm(
    geometry: RobotGeometry, start: JointPosition, axis: Axis, direction: int
) -> float:
    tip = gamma.forward(geometry, start)
    way_mm = 0.0
    while way_mm < geometry.base_width_mm:
        try:
            gamma.inverse(geometry, _shifted(tip, axis, direction * (way_mm + SEARCH_STEP_MM)))
        except KinematicsError:
            break
        way_mm += SEARCH_STEP_MM
    return way_mm - LIMIT_MARGIN_MM


def _shifted(tip: TipPosition, axis: Axis, distance_mm: float) -> TipPosition:
    if axis == "x":
        return tip._replace(x_mm=tip.x_mm + distance_mm)
    if axis == "y":
        return tip._replace(y_mm=tip.y_mm + distance_mm)
    raise ControlError(f"{axis} is not an axis of the base frame that can be jogged.")


def _at_most(limits: MotionLimits, speed_mm_s: float) -> MotionLimits:
    def slower(joint: JointLimits) -> JointLimits:
        return joint.model_copy(update={"velocity_mm_s": min(joint.velocity_mm_s, speed_mm_s)})

    return MotionLimits(
        rho1=slower(limits.rho1), rho2=slower(limits.rho2), rho3=slower(limits.rho3)
    )
