"""The go-e charger behind the station protocol.

Its forced state `frc` has no owner: whoever writes last wins. So hold() is the same as stop(),
outranks nobody, and is a hold only behind an energy manager that is off.
"""

from __future__ import annotations

import math

from drivers.station.errors import (
    StationHeldError,
    StationRefusedError,
    StationUnsupportedError,
)
from drivers.station.freshness import ClockWatch
from drivers.station.goe.answers import (
    CHARGING,
    CONTACTOR_STUCK,
    IDLE,
    LOCK_STATES,
    NEUTRAL,
    OFF,
    ON,
    QUERY,
    Setting,
    Status,
)
from drivers.station.memory import StationMemory
from drivers.station.protocol import StationCapabilities, StationSnapshot
from drivers.station.settings import GoeSettings
from drivers.station.web import WebDevice
from drivers.station.web_station import WebStation

SAME_MOMENT_S = 1.0


class GoeStation(WebStation):
    """Implements StationDriver.

    Args:
        settings: Where it is.
        memory: Keeps that a hold is ours.
    """

    def __init__(self, settings: GoeSettings, memory: StationMemory) -> None:
        super().__init__(WebDevice("go-e charger", settings.url, settings.timeout_s))
        self._memory = memory
        self._hold_name = f"goe {settings.url} hold"
        self._clock = ClockWatch(self.name, SAME_MOMENT_S)

    @property
    def capabilities(self) -> StationCapabilities:
        """It opens its own socket by itself; the inlet of the car is the car's."""
        return StationCapabilities(
            switches=True, holds=False, unlocks=False, limits_current=True, **self._web.bounds(1, 2)
        )

    async def _look(self) -> None:
        await self._web.read(Status, QUERY)

    async def snapshot(self) -> StationSnapshot:
        """Read the station now.

        Raises:
            StationError: see drivers/station/errors.py.
        """
        status, asked_s = await self._web.read(Status, QUERY)
        self._clock.check(status.rbt, asked_s)
        ours = await self._memory.get(self._hold_name) is not None
        return StationSnapshot(
            sampled_at_s=asked_s,
            pilot=status.pilot,
            enabled=status.alw or status.frc == ON,
            held=ours and status.frc == OFF,
            contactor_closed=status.car == CHARGING or status.err == CONTACTOR_STUCK,
            connector_locked=LOCK_STATES.get(status.cus) if status.cus is not None else None,
            power_w=status.power_w,
            currents_a=status.currents_a,
            session_energy_wh=status.wh,
        )

    async def start(self) -> None:
        """Allow power.

        Raises:
            StationHeldError: a hold of ours is in force.
        """
        if await self._memory.get(self._hold_name) is not None:
            raise StationHeldError(f"{self.name} is held; release it before it may give power.")
        await self._force(ON)

    async def stop(self) -> None:
        """Forbid power; the snapshot shows when it has really gone."""
        await self._force(OFF)

    async def hold(self) -> None:
        """Forbid power until release(); any other client can undo it."""
        await self._memory.put(self._hold_name, "off")
        await self._force(OFF)

    async def release(self) -> None:
        """Neutral once the car is gone; with a car connected the power stays off."""
        status, _ = await self._web.read(Status, QUERY)
        if status.car == IDLE and status.frc == OFF:
            await self._force(NEUTRAL)
        await self._memory.put(self._hold_name, None)

    async def unlock(self) -> None:
        """Nobody can open the lock of the car from here.

        Raises:
            StationUnsupportedError: always.
        """
        raise StationUnsupportedError(f"{self.name} cannot unlock the car: open it from the car.")

    async def limit_current(self, current_a: float) -> None:
        """It takes whole amperes."""
        setting, _ = await self._web.read(Setting, f"/api/set?amp={math.floor(current_a)}")
        self._require(setting.amp)

    async def _force(self, state: int) -> None:
        setting, _ = await self._web.read(Setting, f"/api/set?frc={state}")
        self._require(setting.frc)

    def _require(self, said: bool | str | None) -> None:
        if said is not True:
            raise StationRefusedError(
                f"{self.name} refused the setting ({said}). Allow the local API v2 in its app."
            )
