"""A place to go to that somebody has pointed at: planned and checked first, reached by holding.

Nothing moves by pointing. A target is a plan from where the robot stands, checked along its whole
length as any motion is; it is followed while somebody holds a button, and forgotten when the robot
has moved otherwise.
"""

from __future__ import annotations

import asyncio
import math
import uuid
from collections.abc import Callable
from dataclasses import dataclass

from server.control.errors import MotionOutOfReachError, RobotNotReadyError, TargetGoneError
from server.control.jog import Jog
from server.control.model import RobotMode
from server.control.path_check import FORCE_PERIOD_S, check_path
from server.control.supervisor import Supervisor
from twin.errors import TwinError
from twin.joints import JointPosition, TipPosition
from twin.kinematics import gamma
from twin.motion import MotionPlan, plan_straight_line
from twin.statics import PlanForces, forces_along

STANDS_MM = 1e-3
"""A robot this near to the start of a plan is there: a board takes no plan from further away."""


@dataclass(frozen=True, slots=True)
class Target:
    """A checked way to a place.

    Attributes:
        id: Names it.
        tip: Where the plug's tip shall be.
        plan: How it gets there, from where the robot stood.
        forces: What the actuators carry on the way.
    """

    id: str
    tip: TipPosition
    plan: MotionPlan
    forces: PlanForces


class Targets:
    """Knows the one target there is, if any.

    Args:
        supervisor: Owner of the robot.
        jog: Follows plans for as long as somebody holds a button.
    """

    def __init__(self, supervisor: Supervisor, jog: Jog) -> None:
        self._supervisor = supervisor
        self._jog = jog
        self._target: Target | None = None
        self._listeners: list[Callable[[], None]] = []
        supervisor.listen(self._look)

    @property
    def target(self) -> Target | None:
        """Where somebody wants to go; None after that was done or given up."""
        return self._target

    def listen(self, listener: Callable[[], None]) -> None:
        """Call ``listener`` whenever there is another target, or none any more."""
        self._listeners.append(listener)

    async def choose(self, x_mm: float, y_mm: float, speed_mm_s: float) -> Target:
        """Plan and check the straight way of the plug's tip; nothing moves.

        Args:
            x_mm: Where the tip shall be along the rail; how far it is out stays as it is.
            y_mm: And how high.
            speed_mm_s: Of the tip, at most.

        Raises:
            ControlError: the robot is not ready, the plug forbids it, or it leaves the limits.
        """
        supervisor = self._supervisor
        await self._jog.wait_released()
        hindrance = supervisor.why_not_moving()
        if hindrance is not None:
            raise hindrance
        if supervisor.mode is RobotMode.MOVING:
            raise RobotNotReadyError("The robot is moving.")
        geometry, strength = supervisor.geometry, supervisor.strength
        start = supervisor.telemetry.require().commanded.position
        try:
            tip = gamma.forward(geometry, start)._replace(x_mm=x_mm, y_mm=y_mm)
            plan = plan_straight_line(
                geometry, supervisor.limits, start, tip, tip_speed_mm_s=speed_mm_s
            )
            check_path(geometry, supervisor.plug, plan, strength)
            forces = await asyncio.to_thread(
                forces_along,
                geometry,
                plan,
                loads=strength.loads,
                limits=strength.actuators,
                period_s=FORCE_PERIOD_S,
            )
        except TwinError as error:
            raise MotionOutOfReachError(str(error)) from error
        if not _is_at(supervisor.telemetry.require().commanded.position, start):
            raise RobotNotReadyError("The robot has moved while the way was planned.")
        target = Target(str(uuid.uuid4()), tip, plan, forces)
        self._set(target)
        return target

    def hold(self, target_id: str) -> None:
        """The button is held: begin to follow the way, or go on.

        Raises:
            TargetGoneError: it is not the target any more.
            ControlError: somebody else has control, or the robot may not or cannot go there.
        """
        self._jog.hold_plan(target_id, lambda: self._plan_of(target_id))

    def forget(self) -> None:
        """Nobody wants to go there any more; a motion that is under way ends."""
        if self._target is not None:
            self._jog.release()
            self._set(None)

    def _plan_of(self, target_id: str) -> MotionPlan:
        target = self._target
        if target is None or target.id != target_id:
            raise TargetGoneError("Somebody has chosen another place, or the robot has moved.")
        return target.plan

    def _look(self) -> None:
        """A robot that stands anywhere but at the start has no use for the plan."""
        target, state = self._target, self._supervisor.telemetry.latest
        if target is None or state is None or self._supervisor.plan is target.plan:
            return
        if not _is_at(state.commanded.position, target.plan.start.position):
            self._set(None)

    def _set(self, target: Target | None) -> None:
        self._target = target
        for listener in self._listeners:
            listener()


def _is_at(joints: JointPosition, place: JointPosition) -> bool:
    return math.dist(joints, place) <= STANDS_MM
