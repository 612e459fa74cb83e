"""Jogging: steps, and hold-to-move with a dead-man's lease."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Hashable
from functools import partial
from typing import Literal

from server.control.errors import (
    ControlError,
    ControlLostError,
    MotionOutOfReachError,
    RobotNotReadyError,
)
from server.control.lease import Lease
from server.control.motion import Motion
from server.control.path_check import can_hold
from server.control.supervisor import Supervisor
from server.errors import PlugPilotError
from twin.errors import TwinError
from twin.geometry import RobotGeometry
from twin.joints import JointPosition, TipPosition
from twin.kinematics import KinematicsError, SingularityLimits, gamma, singularity
from twin.motion import JointLimits, MotionLimits, MotionPlan, plan_joint_move, plan_straight_line

_log = logging.getLogger(__name__)

Axis = Literal["rho1", "rho2", "rho3", "x", "y", "insertion"]

DEAD_MAN_S = 0.25
"""Silence after which a held button counts as released."""

LIMIT_MARGIN_MM = 0.5
FIRST_STRIDE_MM = 8.0
LAST_STRIDE_MM = 0.25

SOMEBODY = "A technician"
"""While nobody has said who it is."""

_JOINT_OF = {"rho1": 0, "rho2": 1, "rho3": 2, "insertion": 2}


class Jog:
    """Moves one axis at a time for a person.

    Args:
        supervisor: Owner of the robot.
        dead_man_s: Silence after which a held button counts as released, in event loop time.

    Attributes:
        operator: Whose hand it is; whoever else watches sees the name.
    """

    def __init__(self, supervisor: Supervisor, dead_man_s: float = DEAD_MAN_S) -> None:
        self._supervisor = supervisor
        self._dead_man_s = dead_man_s
        self._task: asyncio.Task[None] | None = None
        self._held: Hashable | None = None
        self._deadline: asyncio.TimerHandle | None = None
        self._step: Motion | None = None
        self._step_over = asyncio.Event()
        self.operator = SOMEBODY

    async def step(self, axis: Axis, distance_mm: float, speed_mm_s: float) -> None:
        """Move one axis by a distance; returns when it is there.

        Raises:
            ControlError: somebody else has control, or the robot may not or cannot go there.
            ControlLostError: control changed hands on the way.
        """
        async with (
            self._supervisor.control("jog", self.operator) as lease,
            self._supervisor.plug_may_move(),
        ):
            plan = self._plan(axis, distance_mm, speed_mm_s)
            self._step = self._supervisor.start_motion(lease, plan)
            self._step_over.clear()
            try:
                await self._supervisor.run(self._step)
            finally:
                self._step = None
                self._step_over.set()

    def hold(self, axis: Axis, direction: int, speed_mm_s: float) -> None:
        """The button is held: begin to move, or go on.

        Another axis or direction first stops the motion; it begins with the next call after
        the robot has come to rest.

        Raises:
            ControlError: somebody else has control, or the robot may not or cannot go there.
        """

        def plan() -> MotionPlan:
            distance_mm = direction * self._way_left_mm(axis, direction)
            return self._plan(axis, distance_mm, speed_mm_s)

        self.hold_plan((axis, direction), plan)

    def hold_plan(self, what: Hashable, make_plan: Callable[[], MotionPlan]) -> None:
        """The button of a motion is held: begin it, or go on.

        Anything else that is held first stops; the motion begins with the next call after the
        robot has come to rest.

        Args:
            what: Names the motion: the same one as long as it is equal.
            make_plan: Plans it from where the robot stands; asked only at its beginning.

        Raises:
            ControlError: somebody else has control, or the robot may not or cannot go there.
        """
        if self._task is not None:
            if self._held == what:
                self._restart_timer()
            else:
                self.release()
            return
        lease = self._supervisor.acquire("jog", self.operator)
        try:
            motion = self._supervisor.start_motion(lease, make_plan())
        except BaseException:
            self._supervisor.give_back(lease)
            raise
        self._held = what
        self._task = asyncio.create_task(self._move(motion), name="jog")
        # Not in the task: one that is cancelled before its first step never runs.
        self._task.add_done_callback(partial(self._ended, lease))
        self._restart_timer()

    def release(self) -> None:
        """The button was released, or its owner has gone: stop now."""
        self._stop_timer()
        if self._held is not None and self._task is not None:
            self._held = None
            self._task.cancel()

    async def break_off(self, reason: str) -> None:
        """End whatever a hand moves, and wait until it has come to rest."""
        self.release()
        if self._step is not None:
            self._step.interrupt(ControlLostError(reason))
            await self._step_over.wait()
        await self.wait_stopped()

    async def wait_stopped(self) -> None:
        """Wait until the held motion has come to rest."""
        if self._task is not None:
            await asyncio.wait([self._task])

    async def wait_released(self) -> None:
        """Wait until a motion that nobody holds any more has come to rest."""
        if self._held is None:
            await self.wait_stopped()

    async def _move(self, motion: Motion) -> None:
        try:
            async with self._supervisor.plug_may_move():
                await self._supervisor.run(motion)
        except PlugPilotError as error:
            _log.warning("jogging ended: %s", error.detail)

    def _ended(self, lease: Lease, task: asyncio.Task[None]) -> None:
        self._task = self._held = None
        self._stop_timer()
        self._supervisor.give_back(lease)
        if not task.cancelled() and task.exception() is not None:
            _log.error("jogging broke down", exc_info=task.exception())

    def _restart_timer(self) -> None:
        self._stop_timer()
        loop = asyncio.get_running_loop()
        self._deadline = loop.call_later(self._dead_man_s, self.release)

    def _stop_timer(self) -> None:
        if self._deadline is not None:
            self._deadline.cancel()
            self._deadline = None

    def _plan(self, axis: Axis, distance_mm: float, speed_mm_s: float) -> MotionPlan:
        supervisor = self._supervisor
        start = supervisor.telemetry.require().commanded.position
        try:
            if axis in _JOINT_OF:
                target = _further(supervisor.geometry, start, axis, distance_mm)
                return plan_joint_move(_at_most(supervisor.limits, speed_mm_s), start, target)
            tip = _shifted(gamma.forward(supervisor.geometry, start), axis, distance_mm)
            return plan_straight_line(
                supervisor.geometry, supervisor.limits, start, tip, tip_speed_mm_s=speed_mm_s
            )
        except TwinError as error:
            raise MotionOutOfReachError(str(error)) from error

    def ways_left_mm(self) -> dict[Axis, tuple[float, float]]:
        """How far each axis can go back and on, less a margin [mm].

        Raises:
            RobotOfflineError: there is no telemetry.
            RobotNotReadyError: nobody knows where the joints are.
        """
        if not self._supervisor.telemetry.require().homed:
            raise RobotNotReadyError("The robot does not know its position.")
        return {
            axis: (self._way_mm(axis, -1), self._way_mm(axis, 1))
            for axis in ("x", "y", "insertion", "rho1", "rho2", "rho3")
        }

    def _way_left_mm(self, axis: Axis, direction: int) -> float:
        way_mm = self._way_mm(axis, direction)
        if way_mm <= 0:
            raise MotionOutOfReachError(f"{axis} is at the end of its travel.", axis=axis)
        return way_mm

    def _way_mm(self, axis: Axis, direction: int) -> float:
        """How far the axis can go in a direction, less a margin; 0 at the end [mm]."""
        start = self._supervisor.telemetry.require().commanded.position
        way_mm, stride_mm = 0.0, FIRST_STRIDE_MM
        while stride_mm >= LAST_STRIDE_MM:
            if self._can_stand(start, axis, direction * (way_mm + stride_mm)):
                way_mm += stride_mm
            else:
                stride_mm /= 2
        return max(way_mm - LIMIT_MARGIN_MM, 0.0)

    def _can_stand(self, start: JointPosition, axis: Axis, distance_mm: float) -> bool:
        """Whether the robot can be that much further along an axis, and hold itself there."""
        geometry = self._supervisor.geometry
        try:
            joints = _further(geometry, start, axis, distance_mm)
            gamma.check_joint_limits(geometry, joints)
            singularity.check(geometry, joints, SingularityLimits())
            return can_hold(geometry, start, joints, self._supervisor.strength)
        except KinematicsError:
            return False


def _further(
    geometry: RobotGeometry, start: JointPosition, axis: Axis, distance_mm: float
) -> JointPosition:
    """Joints that much further along an axis."""
    if axis in _JOINT_OF:
        joints = list(start)
        joints[_JOINT_OF[axis]] += distance_mm
        return JointPosition(*joints)
    return gamma.inverse(geometry, _shifted(gamma.forward(geometry, start), axis, distance_mm))


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
