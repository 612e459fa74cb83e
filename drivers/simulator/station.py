"""The simulated station behind the station protocol, with the ways in which stations misbehave."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from drivers.simulator.charge_point import ChargePoint
from drivers.simulator.world import SimulatedWorld
from drivers.station import (
    StationAnswerError,
    StationCapabilities,
    StationError,
    StationSnapshot,
    StationUnreachableError,
)


class SimulatedStation:
    """Implements StationDriver on a simulated world.

    Args:
        world: What the station stands in.
    """

    def __init__(self, world: SimulatedWorld) -> None:
        self._numbers = world.parameters.station
        self._point = ChargePoint(world)
        self._opened = False
        self._hanging = False
        self._lies: dict[str, Any] = {}
        self._frozen: StationSnapshot | None = None
        self._failure: StationError | None = None
        self._clock_error_s = 0.0
        self._restart_after_s: float | None = None
        self._point.on_idle = self._restart_later

    # --- StationDriver -----------------------------------------------------------------------

    @property
    def name(self) -> str:
        """Name a person recognises."""
        return self._numbers.name

    @property
    def capabilities(self) -> StationCapabilities:
        """It can do everything."""
        return StationCapabilities(
            switches=True, holds=self._numbers.holds, unlocks=True, limits_current=True
        )

    async def open(self) -> None:
        """Connect to the station."""
        await self._answer(lambda: None)
        self._opened = True

    async def close(self) -> None:
        """Disconnect; the station goes on by itself. Safe to call twice."""
        self._opened = False

    async def snapshot(self) -> StationSnapshot:
        """Read the station now."""
        self._require_open()
        readings: list[StationSnapshot] = []
        await self._answer(lambda: readings.append(self._read()))
        return readings[0]

    async def start(self) -> None:
        """Allow power.

        Raises:
            StationError: a hold of ours is in force.
        """
        self._require_open()
        if self._point.held:
            raise StationError("The station is held; release it before it may give power.")
        await self._answer(self._point.enable)

    async def stop(self) -> None:
        """Forbid power; the snapshot shows when it has really gone."""
        self._require_open()
        await self._answer(self._point.disable)

    async def hold(self) -> None:
        """Keep the power off against every other controller until release()."""
        self._require_open()
        await self._answer(self._point.hold)

    async def release(self) -> None:
        """End the hold."""
        self._require_open()
        await self._answer(self._point.release)

    async def unlock(self) -> None:
        """Open the connector lock.

        Raises:
            StationError: the station may still give power.
        """
        self._require_open()
        await self._answer(self._point.unlock)

    async def limit_current(self, current_a: float) -> None:
        """Let the car draw no more than this from each phase [A]."""
        self._require_open()
        await self._answer(lambda: self._point.limit(current_a))

    def listen(self, listener: Callable[[], None]) -> None:
        """It only answers, and so never calls ``listener``."""

    @property
    def point(self) -> ChargePoint:
        """Its hardware, for rivals and witnesses who stand beside it."""
        return self._point

    # --- fault injection ---------------------------------------------------------------------

    def hang(self) -> None:
        """No call is answered any more; the power stays as it is."""
        self._hanging = True

    def lie(self, **fields: object) -> None:
        """Report these fields of the snapshot whatever is true.

        Raises:
            TypeError: a snapshot has no such field.
        """
        replace(self._point.snapshot(), **fields)  # type: ignore[arg-type]  # only tests the names
        self._lies = dict(fields)

    def freeze(self) -> None:
        """Repeat the snapshot of this moment for ever, its time included."""
        self._frozen = self._point.snapshot()

    def drop(self) -> None:
        """Nobody listens at its address any more; the power stays as it is."""
        self._failure = StationUnreachableError(f"{self.name} is gone; check its network.")

    def answer_html(self) -> None:
        """A proxy answers in its place, with a page for people."""
        self._failure = StationAnswerError(f"{self.name} answered '<!DOCTYPE html>'.")

    def set_clock(self, error_s: float) -> None:
        """Date all readings wrongly by so much from now on."""
        self._clock_error_s = error_s

    def behave(self) -> None:
        """Answer again, with the truth."""
        self._hanging = False
        self._lies = {}
        self._frozen = None
        self._failure = None
        self._clock_error_s = 0.0

    def restart_by_itself(self, after_s: float = 0.5) -> None:
        """A hostile energy manager enables the station again soon after it went off.

        Only a hold keeps it from doing so.
        """
        self._restart_after_s = after_s
        if not self._point.enabled:
            self._restart_later()

    def leave_alone(self) -> None:
        """Send the hostile energy manager away."""
        self._restart_after_s = None

    # --- inside ------------------------------------------------------------------------------

    def _restart_later(self) -> None:
        if self._restart_after_s is not None:
            loop = asyncio.get_running_loop()
            loop.call_later(self._restart_after_s, self._restart)

    def _restart(self) -> None:
        if self._restart_after_s is not None:
            self._point.enable()

    def _read(self) -> StationSnapshot:
        if self._frozen is not None:
            return self._frozen
        truth = self._point.snapshot()
        sampled_at_s = truth.sampled_at_s + self._clock_error_s
        return replace(truth, **{"sampled_at_s": sampled_at_s, **self._lies})

    async def _answer(self, action: Callable[[], None]) -> None:
        """Do something at the station, with the time that its network takes."""
        if self._hanging:
            await asyncio.sleep(self._numbers.timeout_s)
            raise StationError(f"{self.name} did not answer; check its network and power.")
        await asyncio.sleep(self._numbers.answer_s)
        if self._failure is not None:
            raise self._failure
        action()
        await asyncio.sleep(self._numbers.answer_s)

    def _require_open(self) -> None:
        if not self._opened:
            raise StationError(f"{self.name} is not connected.")
