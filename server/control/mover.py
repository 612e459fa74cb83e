"""Executes motions: checked along their whole length first, and never with a load on the plug."""

from __future__ import annotations

import contextlib
from collections.abc import AsyncIterator, Callable

from drivers.robot import RobotIdentity, RobotState
from server.control.board import Board
from server.control.built_robot import BuiltRobot
from server.control.errors import ControlError, RobotOfflineError
from server.control.lease import Lease
from server.control.load_guard import LoadGuard
from server.control.motion import Motion, Watch
from server.control.path_check import Strength, check_path
from server.control.plug_guard import HELD, PlugGuard
from server.control.taken_up import TakenUp, below
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.motion import JointState, MotionLimits, MotionPlan, plan_from_below, plan_joint_move


class Mover:
    """Carries motions out, one at a time, for whoever holds the lease.

    Args:
        board: Executes them.
        geometry: The robot as drawn.
        limits: Of the board.
        plug: Where the plug is.
        load: Proves that no current flows.
        strength: What the robot carries, and what its actuators can.
        hindrance: Tells what stands in the way of any motion.
        identity: Of the board; None before it has answered.

    Attributes:
        built: The robot as it is built, which the board moves.
        play: On which side of their play the carriages rest.
    """

    def __init__(
        self,
        board: Board,
        geometry: RobotGeometry,
        limits: MotionLimits,
        plug: PlugGuard,
        load: LoadGuard,
        *,
        strength: Strength,
        hindrance: Callable[[], ControlError | None],
        identity: Callable[[], RobotIdentity | None],
    ) -> None:
        self.geometry = geometry
        self.built = BuiltRobot()
        self.play = TakenUp()
        self._limits = limits
        self.telemetry = board.telemetry
        self.plug = plug
        self.load = load
        self.strength = strength
        self.load.on_alarm = self._load_alarm
        self._board = board
        self._hindrance = hindrance
        self._identity = identity
        self._motion: Motion | None = None
        self._homing = False
        self._halt_now: Callable[[], None] = lambda: None

    @property
    def limits(self) -> MotionLimits:
        """What motions are planned with."""
        return self.built.limits(self._limits)

    @property
    def plan(self) -> MotionPlan | None:
        """The plan of the motion under way, None while there is none."""
        return self._motion.plan if self._motion else None

    def start_motion(
        self,
        lease: Lease,
        plan: MotionPlan,
        watch: Watch | None = None,
        *,
        changeable: bool = False,
    ) -> Motion:
        """Check a plan along its whole length and prepare its execution (``run``).

        Raises:
            ControlError: the robot is not ready, the plug forbids it, or it leaves the limits.
        """
        lease.require()
        problem = self._hindrance()
        if problem is not None:
            raise problem
        self._check(plan)
        identity = self._identity()
        if identity is None:
            raise RobotOfflineError("The motion board has not identified itself yet.")
        self._motion = Motion(
            self._board, identity, plan, watch, built=self.built, changeable=changeable
        )
        return self._motion

    async def run(self, motion: Motion) -> RobotState:
        """Execute a prepared motion to its end and return the last sample.

        Raises:
            StillUnderLoadError, StationUnsafeError: the plug is, or may be, in a socket, and it is
                not proven (``plug_may_move``) that no current flows.
        """
        try:
            await self.plug.about_to_leave_park()
            self._require_no_load()
            return await motion.run()
        finally:
            self.plug.motion_ended()
            self._motion = None if self._motion is motion else self._motion

    @contextlib.asynccontextmanager
    async def plug_may_move(self, patience_s: float = 0.0) -> AsyncIterator[None]:
        """No current flows in this block, or the motion under way is stopped at once.

        With a plug that is known to be free nothing is asked and nothing is watched.

        Args:
            patience_s: What speaks against it may take so long to pass.

        Raises:
            StillUnderLoadError, StationUnsafeError: it is not so.
        """
        if self.plug.state in HELD:
            async with self.load.watching(patience_s):
                yield
        else:
            yield

    async def follow(
        self, lease: Lease, plan: MotionPlan, watch: Watch | None = None
    ) -> RobotState:
        """Check and execute a plan to its end and return the last sample."""
        return await self.run(self.start_motion(lease, plan, watch))

    async def move_joints(
        self, lease: Lease, target: JointPosition, watch: Watch | None = None
    ) -> RobotState:
        """Move all joints together to a target, as fast as the limits allow."""
        start = self.telemetry.require().commanded.position
        return await self.follow(lease, plan_joint_move(self.limits, start, target), watch)

    async def move_from_below(self, lease: Lease, target: JointPosition) -> RobotState:
        """The same, but both carriages come to the target from below: play is taken up there."""
        state = await self.run(self.start_from_below(lease, target, changeable=False))
        if self.play.from_below:
            return state
        # As this robot is built, a carriage that hardly moved has turned back on the way.
        await self.move_joints(lease, below(self.geometry, target))
        return await self.move_joints(lease, target)

    def start_from_below(
        self, lease: Lease, target: JointPosition, *, changeable: bool = True
    ) -> Motion:
        """Prepare a motion (``run``) whose carriages come to the target from below.

        Raises:
            ControlError: as ``start_motion``.
        """
        start = JointState.at_rest(self.telemetry.require().commanded.position)
        return self.start_motion(lease, self._plan_from_below(start, target), changeable=changeable)

    def retarget(self, motion: Motion, target: JointPosition) -> None:
        """Bend such a motion, while it runs, to another target without stopping.

        Raises:
            ControlError: the new way is not allowed; the old one goes on.
        """

        def replan(start: JointState) -> MotionPlan:
            plan = self._plan_from_below(start, target)
            self._check(plan)
            return plan

        motion.retarget(replan)

    # Inside

    def _plan_from_below(self, start: JointState, target: JointPosition) -> MotionPlan:
        return plan_from_below(
            self.limits,
            start,
            target,
            below(self.geometry, target),
            taken_up=self.play.from_below,
        )

    def _check(self, plan: MotionPlan) -> None:
        check_path(self.geometry, self.plug, plan, self.strength)
        self.built.check_travel(plan)

    def _require_no_load(self) -> None:
        if self.plug.state in HELD:
            self.load.require()

    def _load_alarm(self, reason: ControlError) -> None:
        """The proof that no current flows has ended: nothing may move in the socket."""
        if self.plug.state in HELD and (self._motion is not None or self._homing):
            self._interrupt(reason)
            self._halt_now()

    def _interrupt(self, reason: Exception) -> None:
        if self._motion is not None:
            self._motion.interrupt(reason)
