"""The one owner of the robot: only the supervisor commands the driver.

Whoever wants to move takes the lease. Stop and emergency stop need none, are never queued and
never refused.
"""

from __future__ import annotations

import contextlib
from collections.abc import AsyncIterator, Callable

from drivers.robot import (
    BoardFault,
    BoardState,
    FaultCode,
    RobotDriver,
    RobotDriverError,
    RobotState,
    StopCategory,
)
from server.control import modes
from server.control.board import Board, OnSegments
from server.control.errors import (
    EmergencyStoppedError,
    LateralMotionForbiddenError,
    RobotOfflineError,
    RobotStoppedError,
)
from server.control.evidence import settle_plug
from server.control.latches import Latches
from server.control.lease import Lease, LeaseDesk
from server.control.link import RobotLink
from server.control.listeners import Listeners
from server.control.model import Holder, HolderKind, RobotMode
from server.control.motion import Motion, Watch
from server.control.path_check import DEFAULT_STRENGTH, Strength, check_path
from server.control.plug_guard import HELD, PlugGuard, PlugStore
from server.control.telemetry import Telemetry
from server.timing import Calendar
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.motion import JointState, MotionLimits, MotionPlan, plan_joint_move


class Supervisor:
    """Owns the robot driver, the lease, the latches and the plug guard.

    Args:
        driver: The motion board.
        geometry: Calibrated geometry.
        limits: What motions are planned with.
        plug_store: Where the plug's state survives.
        calendar: Dates for what people see.
        strength: What the robot carries, and what its actuators can.
    """

    def __init__(
        self,
        driver: RobotDriver,
        geometry: RobotGeometry,
        limits: MotionLimits,
        plug_store: PlugStore,
        calendar: Calendar,
        *,
        strength: Strength = DEFAULT_STRENGTH,
    ) -> None:
        self.geometry = geometry
        self.limits = limits
        self.strength = strength
        self.telemetry = Telemetry()
        self.plug = PlugGuard(plug_store, self._changed)
        self._driver = driver
        self._board = Board(driver, self.telemetry, lambda: self.mode)
        self._desk = LeaseDesk(calendar)
        self._latches = Latches()
        self._motion: Motion | None = None
        self._listeners = Listeners()
        self._link = RobotLink(
            driver,
            self.telemetry,
            on_connected=lambda state: settle_plug(self.plug, state, first=True),
            on_sample=self._take_sample,
            on_lost=self._changed,
        )

    # What anyone may know

    @property
    def mode(self) -> RobotMode:
        """What the robot is doing."""
        return modes.derive_mode(
            self.telemetry.latest,
            stopped=self._latches.stopped,
            emergency=self._latches.emergency,
        )

    @property
    def holder(self) -> Holder | None:
        """Who has control."""
        return self._desk.holder

    @property
    def fault(self) -> BoardFault | None:
        """The fault that the board latched."""
        state = self.telemetry.latest
        return state.fault if state else None

    @property
    def name(self) -> str:
        """Name of the robot at the other end, as far as known."""
        return self._link.identity.name if self._link.identity else "not connected"

    @property
    def link_trouble(self) -> RobotDriverError | None:
        """Why there is no link to the motion board."""
        return self._link.trouble

    @property
    def plan(self) -> MotionPlan | None:
        """The plan of the motion under way, None while there is none."""
        return self._motion.plan if self._motion else None

    def listen(self, listener: Callable[[], None]) -> None:
        """Call ``listener`` after every change, telemetry included."""
        self._listeners.add(listener)

    def listen_to_segments(self, listener: OnSegments) -> None:
        """Call the one ``listener`` with all segments that the board has accepted."""
        self._board.on_segments = listener

    # Life

    async def start(self, *, wait: bool = True) -> None:
        """Take up the plug's record and keep a link to the board from now on.

        Args:
            wait: Return only after the first attempt to connect, whether it worked or not.
        """
        await self.plug.recover()
        await self._link.start(wait=wait)

    async def close(self) -> None:
        """Stop the robot and let go of it."""
        await self._link.close()

    # Stops: no lease, never refused

    async def stop(self) -> None:
        """Protective stop: category 2, in force until ``reset``."""
        self._latches.press_stop()
        self._interrupt(RobotStoppedError("Somebody pressed stop."))
        self._changed()
        await self._board.tell_to_stop(lambda: self._driver.stop(StopCategory.DECELERATE_AND_HOLD))

    async def emergency_stop(self) -> None:
        """Emergency stop: category 1, latched until ``reset``."""
        self._latches.press_emergency_stop()
        self._interrupt(EmergencyStoppedError("Somebody pressed the emergency stop."))
        self._changed()
        await self._board.tell_to_stop(self._driver.emergency_stop)

    async def reset(self) -> None:
        """Release stop, emergency stop and fault. Nothing moves by itself afterwards.

        Raises:
            RobotOfflineError: there is no link.
            RobotFaultError: the cause of the fault is still there.
            RobotStoppedError: somebody pressed stop again meanwhile.
        """
        presses = self._latches.presses
        if self.telemetry.require().board is BoardState.FAULT:
            await self._board.clear_fault()
        released = self._latches.release(presses)
        self._changed()
        if not released:
            raise RobotStoppedError("Somebody pressed stop again while it was being released.")

    # Control

    @contextlib.asynccontextmanager
    async def control(self, kind: HolderKind, name: str) -> AsyncIterator[Lease]:
        """Hold the lease for the length of a block.

        Raises:
            ControlBusyError: somebody has it already.
        """
        lease = self.acquire(kind, name)
        try:
            yield lease
        finally:
            self.give_back(lease)

    def acquire(self, kind: HolderKind, name: str) -> Lease:
        """Take the lease; whoever takes it gives it back.

        Raises:
            ControlBusyError: somebody has it already.
        """
        lease = self._desk.acquire(kind, name)
        self._changed()
        return lease

    def give_back(self, lease: Lease) -> None:
        """End a lease."""
        self._desk.give_back(lease)
        self._changed()

    async def enable(self, lease: Lease) -> None:
        """Switch the drives on."""
        lease.require()
        self._refuse_when_stopped()
        await self._board.command(self._driver.enable)
        await self._board.until(lambda state: state.enabled)

    async def disable(self, lease: Lease) -> None:
        """Switch the drives off."""
        lease.require()
        await self._board.command(self._driver.disable)
        await self._board.until(lambda state: not state.enabled)

    async def home(self, lease: Lease) -> None:
        """Let the board find its zero. The plug retracts first, along the insertion axis.

        Raises:
            LateralMotionForbiddenError: the plug is not known to be free; see ``withdraw_home``.
        """
        if self.plug.state in HELD:
            raise LateralMotionForbiddenError(
                "Homing moves sideways, and the plug is not known to be free.",
                plug=self.plug.state.value,
            )
        await self.withdraw_home(lease)

    async def withdraw_home(self, lease: Lease) -> None:
        """Home although the plug may be in a socket: the way out when nothing else is known.

        The board retracts the plug to its switch first, under the force limit, and moves
        sideways only when that succeeded. The caller has made sure that no current flows.
        Whatever ends it early brings the robot to rest first.
        """
        lease.require()
        self._refuse_when_stopped()
        await self.plug.about_to_leave_park()
        self._refuse_when_stopped()  # somebody may have pressed stop meanwhile
        await self._board.home()
        await self.plug.is_free()

    async def halt(self, lease: Lease) -> None:
        """Bring the robot to rest (category 2) without latching anything."""
        lease.require()
        await self._board.command(lambda: self._driver.stop(StopCategory.DECELERATE_AND_HOLD))

    async def release_stall(self, lease: Lease) -> None:
        """Release the fault of a slide that pushed in vain, so that it can be drawn back.

        Any other fault stays latched, and so does a stop: those are for a person to release.

        Raises:
            RobotFaultError: the board keeps the fault.
        """
        lease.require()
        if self.fault is not None and self.fault.code is FaultCode.STALL:
            await self._board.clear_fault()

    async def set_force_limit(self, lease: Lease, force_n: float) -> None:
        """Cap the insertion force on the board [N]."""
        lease.require()
        await self._board.command(lambda: self._driver.set_force_limit(force_n))

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
        problem = modes.why_not_moving(self.mode, self.telemetry.latest)
        if problem is not None:
            raise problem
        check_path(self.geometry, self.plug, plan, self.strength)
        if self._link.identity is None:
            raise RobotOfflineError("The motion board has not identified itself yet.")
        self._motion = Motion(self._board, self._link.identity, plan, watch, changeable=changeable)
        return self._motion

    async def run(self, motion: Motion) -> RobotState:
        """Execute a prepared motion to its end and return the last sample."""
        try:
            await self.plug.about_to_leave_park()
            return await motion.run()
        finally:
            self.plug.motion_ended()
            self._motion = None if self._motion is motion else self._motion

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

    def retarget(self, motion: Motion, target: JointPosition) -> None:
        """Bend a running joint move to another target without stopping.

        Raises:
            ControlError: the new way is not allowed; the old one goes on.
        """

        def replan(start: JointState) -> MotionPlan:
            plan = plan_joint_move(self.limits, start, target)
            check_path(self.geometry, self.plug, plan, self.strength)
            return plan

        motion.retarget(replan)

    def _refuse_when_stopped(self) -> None:
        problem = modes.why_not_preparing(self.mode, self.telemetry.latest)
        if problem is not None:
            raise problem

    def _interrupt(self, reason: Exception) -> None:
        if self._motion is not None:
            self._motion.interrupt(reason)

    async def _take_sample(self, state: RobotState) -> None:
        self._notice_fault(state)
        await settle_plug(self.plug, state, first=False)
        self._changed()

    def _notice_fault(self, state: RobotState) -> None:
        problem = modes.why_fault_ends_motion(state)
        if problem is not None:
            self._latches.emergency |= isinstance(problem, EmergencyStoppedError)
            self._interrupt(problem)

    def _changed(self) -> None:
        self._listeners.tell()
