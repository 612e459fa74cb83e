"""The one owner of the robot: only the supervisor commands the driver.

Whoever wants to move takes the lease. Stop and emergency stop need none, are never queued and
never refused.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import AsyncIterator, Awaitable, Callable

from drivers.robot import (
    BoardFault,
    BoardState,
    FaultCode,
    RobotDriver,
    RobotDriverError,
    RobotState,
    StopCategory,
)
from server.control.errors import (
    EmergencyStoppedError,
    LateralMotionForbiddenError,
    MotionOutOfReachError,
    MotionRefusedError,
    RobotFaultError,
    RobotOfflineError,
    RobotStoppedError,
)
from server.control.lease import Lease, LeaseDesk
from server.control.link import RobotLink
from server.control.model import Holder, HolderKind, PlugState, RobotMode
from server.control.modes import derive_mode, why_not_moving
from server.control.motion import Motion, Watch
from server.control.plug_guard import PlugGuard, PlugStore
from server.control.telemetry import Telemetry
from server.timing import Calendar
from twin.errors import TwinError
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.motion import JointState, MotionLimits, MotionPlan, check_plan, plan_joint_move

_log = logging.getLogger(__name__)

CORRIDOR_TOLERANCE_MM = 0.5
PATH_SAMPLES = 24


class Supervisor:
    """Owns the robot driver, the lease, the latches and the plug guard.

    Args:
        driver: The motion board.
        geometry: Calibrated geometry.
        limits: What motions are planned with.
        plug_store: Where the plug's state survives.
        calendar: Dates for what people see.
    """

    def __init__(
        self,
        driver: RobotDriver,
        geometry: RobotGeometry,
        limits: MotionLimits,
        plug_store: PlugStore,
        calendar: Calendar,
    ) -> None:
        self.geometry = geometry
        self.limits = limits
        self.telemetry = Telemetry()
        self.plug = PlugGuard(plug_store, self._changed)
        self._driver = driver
        self._desk = LeaseDesk(calendar)
        self._stopped = False
        self._emergency = False
        self._motion: Motion | None = None
        self._listeners: list[Callable[[], None]] = []
        self._link = RobotLink(
            driver,
            self.telemetry,
            on_connected=self._compare_plug_with_evidence,
            on_sample=self._take_sample,
            on_lost=self._changed,
        )

    # What anyone may know

    @property
    def mode(self) -> RobotMode:
        """What the robot is doing."""
        return derive_mode(self.telemetry.latest, stopped=self._stopped, emergency=self._emergency)

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

    def listen(self, listener: Callable[[], None]) -> None:
        """Call ``listener`` after every change, telemetry included."""
        self._listeners.append(listener)

    # Life

    async def start(self) -> None:
        """Take up the plug's record and keep a link to the board from now on.

        Returns after the first attempt to connect, whether it worked or not.
        """
        await self.plug.recover()
        await self._link.start()

    async def close(self) -> None:
        """Stop the robot and let go of it."""
        await self._link.close()

    # Stops: no lease, never refused

    async def stop(self) -> None:
        """Protective stop: category 2, in force until ``reset``."""
        self._stopped = True
        self._interrupt(RobotStoppedError("Somebody pressed stop."))
        self._changed()
        await self._tell_board_to_stop(self._driver.stop(StopCategory.DECELERATE_AND_HOLD))

    async def emergency_stop(self) -> None:
        """Emergency stop: category 1, latched until ``reset``."""
        self._emergency = True
        self._interrupt(EmergencyStoppedError("Somebody pressed the emergency stop."))
        self._changed()
        await self._tell_board_to_stop(self._driver.emergency_stop())

    async def reset(self) -> None:
        """Release stop, emergency stop and fault. Nothing moves by itself afterwards.

        Raises:
            RobotOfflineError: there is no link.
            RobotFaultError: the cause of the fault is still there.
        """
        state = self.telemetry.require()
        if state.board is BoardState.FAULT:
            try:
                await self._driver.clear_fault()
            except RobotDriverError as error:
                raise RobotFaultError(f"The fault cannot be released: {error}") from error
            await self._until(lambda sample: sample.board is not BoardState.FAULT)
        self._stopped = False
        self._emergency = False
        self._changed()

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
        await self._command(self._driver.enable())
        await self._until(lambda state: state.enabled)

    async def disable(self, lease: Lease) -> None:
        """Switch the drives off."""
        lease.require()
        await self._command(self._driver.disable())
        await self._until(lambda state: not state.enabled)

    async def home(self, lease: Lease) -> None:
        """Let the board find its zero. The plug retracts first, along the insertion axis.

        Raises:
            LateralMotionForbiddenError: the plug is not known to be free; see ``withdraw_home``.
        """
        if self.plug.state in {PlugState.INSERTED, PlugState.UNKNOWN}:
            raise LateralMotionForbiddenError(
                "Homing moves sideways, and the plug is not known to be free.",
                plug=self.plug.state.value,
            )
        await self.withdraw_home(lease)

    async def withdraw_home(self, lease: Lease) -> None:
        """Home although the plug may be in a socket: the way out when nothing else is known.

        The board retracts the plug to its switch first, under the force limit, and moves
        sideways only when that succeeded. The caller has made sure that no current flows.
        """
        lease.require()
        self._refuse_when_stopped()
        await self._command(self._driver.home())
        await self._until(lambda state: state.homed and state.board is BoardState.READY)
        await self.plug.is_free()

    async def halt(self, lease: Lease) -> None:
        """Bring the robot to rest (category 2) without latching anything."""
        lease.require()
        await self._command(self._driver.stop(StopCategory.DECELERATE_AND_HOLD))

    async def set_force_limit(self, lease: Lease, force_n: float) -> None:
        """Cap the insertion force on the board [N]."""
        lease.require()
        await self._command(self._driver.set_force_limit(force_n))

    def start_motion(self, lease: Lease, plan: MotionPlan, watch: Watch | None = None) -> Motion:
        """Check a plan along its whole length and prepare its execution (``run``).

        Raises:
            ControlError: the robot is not ready, the plug forbids it, or it leaves the limits.
        """
        lease.require()
        state = self.telemetry.latest
        problem = why_not_moving(self.mode, state)
        if problem is not None:
            raise problem
        self._check(plan)
        if self._link.identity is None:
            raise RobotOfflineError("The motion board has not identified itself yet.")
        self._motion = Motion(self._driver, self._link.identity, self.telemetry, plan, watch)
        return self._motion

    async def run(self, motion: Motion) -> RobotState:
        """Execute a prepared motion to its end and return the last sample."""
        await self.plug.about_to_leave_park()
        try:
            return await motion.run()
        finally:
            if self._motion is motion:
                self._motion = None

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
            self._check(plan)
            return plan

        motion.retarget(replan)

    # Inside

    def _check(self, plan: MotionPlan) -> None:
        step_s = plan.duration_s / PATH_SAMPLES
        self.plug.check(
            plan.start.position,
            [plan.position_at(step_s * i) for i in range(1, PATH_SAMPLES + 1)],
        )
        try:
            check_plan(self.geometry, plan)
        except TwinError as error:
            raise MotionOutOfReachError(str(error)) from error

    def _refuse_when_stopped(self) -> None:
        if self.mode in {RobotMode.OFF, RobotMode.NOT_HOMED, RobotMode.HOMING}:
            return
        problem = why_not_moving(self.mode, self.telemetry.latest)
        if problem is not None:
            raise problem

    async def _command(self, call: Awaitable[None]) -> None:
        self.telemetry.require()
        try:
            await call
        except RobotDriverError as error:
            raise self._explain(error) from error

    def _explain(self, error: RobotDriverError) -> Exception:
        problem = why_not_moving(self.mode, self.telemetry.latest)
        if problem is not None and self.mode in {
            RobotMode.EMERGENCY_STOP,
            RobotMode.STOPPED,
            RobotMode.FAULT,
            RobotMode.OFFLINE,
        }:
            return problem
        return MotionRefusedError(f"The motion board refused: {error}")

    async def _until(self, condition: Callable[[RobotState], bool]) -> None:
        try:
            async with asyncio.timeout(1.0):
                while not condition(self.telemetry.require()):
                    await self.telemetry.next()
        except TimeoutError:
            raise MotionRefusedError("The motion board did not do what it was told.") from None

    async def _tell_board_to_stop(self, call: Awaitable[None]) -> None:
        try:
            await call
        except RobotDriverError as error:
            # The latch is set already, and a board without a link stops by its own heartbeat.
            _log.warning("stop could not be sent: %s", error)

    def _interrupt(self, reason: Exception) -> None:
        if self._motion is not None:
            self._motion.interrupt(reason)

    def _take_sample(self, state: RobotState) -> None:
        self._notice_fault(state)
        self._changed()

    async def _compare_plug_with_evidence(self, state: RobotState) -> None:
        if self.plug.state is PlugState.PARKED and not state.homed:
            await self.plug.is_free()
        if self.plug.state is PlugState.INSERTED:
            corridor = self.plug.corridor
            if not (
                state.homed
                and corridor is not None
                and corridor.holds(state.measured.position, CORRIDOR_TOLERANCE_MM)
            ):
                await self.plug.doubt()

    def _notice_fault(self, state: RobotState) -> None:
        if state.fault is None:
            return
        if state.fault.code is FaultCode.EMERGENCY_STOP:
            self._emergency = True
            self._interrupt(EmergencyStoppedError(state.fault.detail))
        else:
            problem = why_not_moving(RobotMode.FAULT, state)
            if problem is not None:
                self._interrupt(problem)

    def _changed(self) -> None:
        for listener in self._listeners:
            listener()
