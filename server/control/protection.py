"""Stops: who pressed them, what the watchdogs found, how they are watched and released.

- Protective stop (category 2): the drives hold, standstill is monitored; a robot that does not
  come to rest, or creeps, loses its power.
- Emergency stop (category 1): the drives are released, and everything stays latched.

A person's stop ends only by a person. A watchdog's stop ends by itself once its cause is gone,
but only with the plug free: nothing moves by that, since whatever was under way has ended.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Coroutine

from drivers.robot import BoardState, RobotDriver, RobotState, StopCategory
from server.config.supervision import SupervisionSettings
from server.control import modes
from server.control.board import MOVING, Board
from server.control.errors import (
    EmergencyStoppedError,
    ReleaseRefusedError,
    RobotStoppedError,
)
from server.control.latches import Latches
from server.control.plug_guard import PlugGuard
from server.control.release import ReleaseCondition, is_harmless, release_conditions
from server.control.standstill import StandstillMonitor
from server.control.stop_cause import PRESSED, StopCause, stale_telemetry

_log = logging.getLogger(__name__)

GRACE_S = 0.02
"""A computer that was busy reads what has waited before it believes in silence."""

Interrupt = Callable[[Exception], None]


class Protection:
    """Latches, watchdog over the telemetry, and monitor of standstill.

    Args:
        driver: The motion board.
        board: The same, as the supervisor speaks to it.
        plug: Where the plug is.
        settings: Ages, times and tolerances.
        interrupt: Ends the motion under way with a reason.
        changed: Called when anybody should look again.
    """

    def __init__(
        self,
        driver: RobotDriver,
        board: Board,
        plug: PlugGuard,
        settings: SupervisionSettings,
        *,
        interrupt: Interrupt,
        changed: Callable[[], None],
    ) -> None:
        self._driver = driver
        self._board = board
        self._plug = plug
        self._settings = settings
        self._interrupt = interrupt
        self._changed = changed
        self._latches = Latches()
        self._standstill = StandstillMonitor(settings)
        self._silence: asyncio.TimerHandle | None = None
        self._sending: set[asyncio.Task[None]] = set()
        self._releasable_since_s: float | None = None

    @property
    def cause(self) -> StopCause | None:
        """Why the protective stop is in force; None while there is none."""
        return self._latches.cause

    @property
    def emergency(self) -> bool:
        """The emergency stop is in force."""
        return self._latches.emergency

    def conditions(self) -> list[ReleaseCondition]:
        """What must be so before a stop is released."""
        return release_conditions(
            self._board.telemetry.latest, asyncio.get_running_loop().time(), self._settings
        )

    # Stops

    async def stop(self, cause: StopCause = PRESSED) -> None:
        """Protective stop: category 2, in force until it is released."""
        self._latch(cause)
        await self._send_stop()

    def stop_now(self, cause: StopCause) -> None:
        """The same for whoever cannot wait: latched at once, sent in the background."""
        self._latch(cause)
        self._in_background(self._send_stop(), "protective stop")

    def halt_now(self) -> None:
        """Bring the robot to rest (category 2) without latching anything, in the background."""
        self._in_background(self._send_stop(), "halt")

    async def emergency_stop(self, reason: str = "Somebody pressed the emergency stop.") -> None:
        """Emergency stop: category 1, latched until it is released."""
        self._latches.press_emergency_stop()
        self._interrupt(EmergencyStoppedError(reason))
        self._changed()
        await self._board.tell_to_stop(self._driver.emergency_stop)

    async def reset(self) -> None:
        """Release stop, emergency stop and fault. Nothing moves by itself afterwards.

        Raises:
            RobotOfflineError: there is no link.
            RobotFaultError: the cause of the fault is still there.
            ReleaseRefusedError: something still speaks against it; ``conditions`` names it.
            RobotStoppedError: somebody pressed stop again meanwhile.
        """
        presses = self._latches.presses
        if self._board.telemetry.require().board is BoardState.FAULT:
            await self._board.clear_fault()
        await self._until_releasable()
        await self._settle_plug()
        if not self._release(presses):
            raise RobotStoppedError("Somebody pressed stop again while it was being released.")

    # Watching

    def take(self, state: RobotState) -> None:
        """Look at a telemetry sample."""
        problem = modes.why_fault_ends_motion(state)
        if problem is not None:
            self._latches.emergency |= isinstance(problem, EmergencyStoppedError)
            self._interrupt(problem)
        trouble = self._standstill.check(state)
        if trouble is not None and not self.emergency:
            _log.error("%s Its power is cut.", trouble)
            self._in_background(self.emergency_stop(trouble), "emergency stop")
        self._expect_next(state)
        self._release_if_harmless(state)

    def lose(self) -> None:
        """The link went down: the board stops by itself, and nobody sees the robot."""
        self._expect_nothing()
        self._standstill.disarm()

    def _expect_next(self, state: RobotState) -> None:
        self._expect_nothing()
        if state.board in MOVING:
            loop = asyncio.get_running_loop()
            due_s = state.sampled_at_s + self._settings.telemetry_age_s
            self._silence = loop.call_at(
                max(due_s, loop.time() + GRACE_S), self._too_old, state.sampled_at_s
            )

    def _expect_nothing(self) -> None:
        if self._silence is not None:
            self._silence.cancel()
            self._silence = None

    def _too_old(self, sampled_at_s: float) -> None:
        age_s = asyncio.get_running_loop().time() - sampled_at_s
        _log.error("the newest telemetry of the moving robot is %.0f ms old", 1e3 * age_s)
        self.stop_now(stale_telemetry(age_s))

    # Inside

    def _latch(self, cause: StopCause) -> None:
        self._latches.press_stop(cause)
        self._standstill.arm(asyncio.get_running_loop().time())
        self._releasable_since_s = None
        self._interrupt(cause.as_error())
        self._changed()

    async def _send_stop(self) -> None:
        await self._board.tell_to_stop(lambda: self._driver.stop(StopCategory.DECELERATE_AND_HOLD))

    def _in_background(self, work: Coroutine[None, None, None], name: str) -> None:
        task = asyncio.create_task(work, name=name)
        self._sending.add(task)
        task.add_done_callback(self._sending.discard)

    async def _until_releasable(self) -> None:
        """Wait for a robot that is still coming to rest.

        Raises:
            ReleaseRefusedError: a condition is not met in time.
        """
        try:
            async with asyncio.timeout(self._settings.stopping_s):
                while missing := [one for one in self.conditions() if not one.met]:
                    await self._board.telemetry.next()
        except TimeoutError:
            raise ReleaseRefusedError(
                " ".join(one.words for one in missing), missing=[one.code for one in missing]
            ) from None

    async def _settle_plug(self) -> None:
        """A plug that is no longer on its way in or out is at an unknown place."""
        state, corridor = self._board.telemetry.require(), self._plug.corridor
        tolerance_mm = self._settings.standstill_mm
        if corridor is not None and not corridor.holds(state.measured.position, tolerance_mm):
            await self._plug.doubt()

    def _release(self, presses: int) -> bool:
        released = self._latches.release(presses)
        if released:
            self._standstill.disarm()
        self._changed()
        return released

    def _release_if_harmless(self, state: RobotState) -> None:
        """End a watchdog's stop once its cause has been gone for a while."""
        cause, wait_s = self.cause, self._settings.release_after_s
        wanted = cause is not None and not cause.by_person and not self.emergency and wait_s > 0
        safe = state.fault is None and is_harmless(self._plug)
        if not (wanted and safe and all(one.met for one in self.conditions())):
            self._releasable_since_s = None
            return
        if self._releasable_since_s is None:
            self._releasable_since_s = state.sampled_at_s
        elif state.sampled_at_s - self._releasable_since_s >= wait_s:
            _log.warning("the protective stop ends: %s That is over.", cause and cause.words)
            self._release(self._latches.presses)
