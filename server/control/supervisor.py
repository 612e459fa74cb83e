"""The one owner of the robot: only the supervisor commands the driver.

Whoever wants to move takes the lease. Stop and emergency stop need none, are never queued and
never refused.
"""

from __future__ import annotations

import contextlib
from collections.abc import AsyncIterator, Callable

from drivers.robot import (
    BoardFault,
    FaultCode,
    RobotDriver,
    RobotDriverError,
    RobotIdentity,
    RobotState,
    StopCategory,
)
from drivers.station import StationDriver
from server.config.supervision import SupervisionSettings
from server.control import modes
from server.control.board import Board, OnSegments
from server.control.built_robot import BuiltRobot
from server.control.errors import CalibrationHeldError, ControlError, LateralMotionForbiddenError
from server.control.evidence import settle_plug
from server.control.lease import Lease, LeaseDesk
from server.control.link import RobotLink
from server.control.listeners import Listeners
from server.control.load_guard import LoadGuard
from server.control.model import Holder, HolderKind, PlugState, RobotMode
from server.control.mover import Mover
from server.control.path_check import DEFAULT_STRENGTH, Strength
from server.control.plug_answer import PlugWitness
from server.control.plug_guard import HELD, PlugGuard, PlugStore
from server.control.protection import Protection
from server.control.release import ReleaseCondition
from server.control.stop_cause import StopCause
from server.control.telemetry import Telemetry
from server.timing import Calendar
from twin.geometry import RobotGeometry
from twin.motion import MotionLimits


class Supervisor(Mover):
    """Owns the robot driver, the lease, the stops, the plug guard and the load guard.

    Args:
        driver: The motion board.
        geometry: The robot as drawn.
        limits: What motions are planned with.
        plug_store: Where the plug's state survives.
        calendar: Dates for what people see.
        station: The charging station: the plug moves in a socket only while it shows no load.
        settings: Of the watchdogs.
        strength: What the robot carries, and what its actuators can.
        built: What is known of the robot as it was built; None: as drawn.
    """

    def __init__(
        self,
        driver: RobotDriver,
        geometry: RobotGeometry,
        limits: MotionLimits,
        plug_store: PlugStore,
        calendar: Calendar,
        *,
        station: StationDriver,
        settings: SupervisionSettings,
        strength: Strength = DEFAULT_STRENGTH,
        built: BuiltRobot | None = None,
    ) -> None:
        telemetry = Telemetry()
        plug = PlugGuard(plug_store, self._changed)
        board = Board(driver, telemetry, lambda: self.mode)
        super().__init__(
            board,
            geometry,
            limits,
            plug,
            LoadGuard(station, settings),
            strength=strength,
            hindrance=self.why_not_moving,
            identity=lambda: self._link.identity,
        )
        self.built = built or self.built
        self._driver = driver
        self._witness = PlugWitness(plug, station, settings)
        self._desk = LeaseDesk(calendar)
        self.reserved_for: str | None = None  # who commands by hand; no job begins by itself
        self._listeners = Listeners()
        self._protection = Protection(
            driver, board, plug, settings, interrupt=self._interrupt, changed=self._changed
        )
        self._halt_now = self._protection.halt_now
        self._link = RobotLink(
            driver,
            self.telemetry,
            seen=self._seen,
            on_connected=lambda state: settle_plug(self.plug, state, first=True),
            on_sample=self._take_sample,
            on_lost=self._lost,
        )

    # What anyone may know

    @property
    def mode(self) -> RobotMode:
        """What the robot is doing."""
        return modes.derive_mode(
            self.telemetry.latest,
            stopped=self._protection.cause is not None,
            emergency=self._protection.emergency,
        )

    @property
    def stop_cause(self) -> StopCause | None:
        """Why a protective stop is in force; None while there is none."""
        return self._protection.cause

    @property
    def release_conditions(self) -> list[ReleaseCondition]:
        """What must be so before a stop is released."""
        return self._protection.conditions()

    def why_not_moving(self) -> ControlError | None:
        """What stands in the way of any motion, in words; None when nothing does."""
        return modes.why_not_moving(self.mode, self.telemetry.latest, self.stop_cause)

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
    def identity(self) -> RobotIdentity | None:
        """How the robot at the other end has introduced itself; None before it has."""
        return self._link.identity

    @property
    def board_state(self) -> RobotState | None:
        """The newest sample in the board's own joints, None while there is no link."""
        return self._link.newest

    @property
    def link_trouble(self) -> RobotDriverError | None:
        """Why there is no link to the motion board."""
        return self._link.trouble

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
        await self._protection.stop()

    async def emergency_stop(self) -> None:
        """Emergency stop: category 1, latched until ``reset``."""
        await self._protection.emergency_stop()

    async def reset(self) -> None:
        """Release stop, emergency stop and fault; see ``Protection.reset``. Nothing moves."""
        await self._protection.reset()

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

    async def take_plug_answer(self, lease: Lease, answer: PlugState) -> None:
        """Write down where a person has seen the plug; see ``PlugWitness.take_answer``."""
        lease.require()
        await self._witness.take_answer(answer)

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
        sideways only when that succeeded. Whatever ends it early brings the robot to rest first.

        Raises:
            StillUnderLoadError, StationUnsafeError: the plug may be in a socket, and it is not
                proven (``plug_may_move``) that no current flows.
        """
        lease.require()
        self._refuse_when_stopped()
        await self.plug.about_to_leave_park()
        self._refuse_when_stopped()  # somebody may have pressed stop meanwhile
        self._require_no_load()
        self._homing = True
        try:
            await self._board.home()
        except ControlError:
            self._require_no_load()  # the alarm is the reason
            raise
        finally:
            self._homing = False
        await self.plug.is_free()

    def use_built(self, lease: Lease, built: BuiltRobot) -> None:
        """From now on the robot is built like this. Nothing moves by it.

        Raises:
            CalibrationHeldError: the plug is, or may be, in a socket, and its way out is known in
                the joints that count now.
        """
        lease.require()
        if self.plug.state in HELD:
            raise CalibrationHeldError(
                f"The plug is {self.plug.state.value}.", plug=self.plug.state.value
            )
        self.built = built
        self._link.see_anew()
        self._changed()

    async def halt(self, lease: Lease) -> None:
        """Bring the robot to rest (category 2) without latching anything."""
        lease.require()
        await self._board.command(lambda: self._driver.stop(StopCategory.DECELERATE_AND_HOLD))

    async def release_fault(self, lease: Lease, *codes: FaultCode) -> None:
        """Release one of these faults; any other, and a stop, are for a person to release.

        Raises:
            RobotFaultError: the board keeps the fault.
        """
        lease.require()
        if self.fault is not None and self.fault.code in codes:
            await self._board.clear_fault()

    async def release_stall(self, lease: Lease) -> None:
        """Release the fault of a slide that pushed in vain, so that it can be drawn back."""
        await self.release_fault(lease, FaultCode.STALL)

    async def set_force_limit(self, lease: Lease, force_n: float) -> None:
        """Cap the insertion force on the board, in true newtons."""
        lease.require()
        await self._board.command(lambda: self._driver.set_force_limit(self.built.shown_n(force_n)))

    # Inside

    def _refuse_when_stopped(self) -> None:
        problem = modes.why_not_preparing(self.mode, self.telemetry.latest, self.stop_cause)
        if problem is not None:
            raise problem

    async def _take_sample(self, state: RobotState) -> None:
        self._protection.take(state)
        await settle_plug(self.plug, state, first=False)
        self._changed()

    def _seen(self, state: RobotState) -> RobotState:
        self.play.follow(state)
        return self.built.seen(state)  # as it is built at that moment

    def _lost(self) -> None:
        self._protection.lose()
        self.play.forget()
        self._changed()

    def _changed(self) -> None:
        self._listeners.tell()
