"""The OpenEVSE behind the station protocol.

Its clients make claims with priorities. An override has 1000 and belongs to everybody: whoever
writes last wins. A limit that is reached has 1100 and outranks it, so a limit of 1 Wh is the hold.
It only bites once the session has had that energy; below, the first Wh after a restart sets it off.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Callable

import httpx
from pydantic import JsonValue

from drivers.station.errors import (
    StationHeldError,
    StationRefusedError,
    StationUnsupportedError,
)
from drivers.station.freshness import ClockWatch
from drivers.station.memory import StationMemory
from drivers.station.openevse.answers import Limit, Override, Status
from drivers.station.openevse.push import LoadWatch
from drivers.station.protocol import (
    PilotState,
    StationCapabilities,
    StationSnapshot,
)
from drivers.station.settings import OpenevseSettings
from drivers.station.web import WebDevice
from drivers.station.web_station import WebStation

_log = logging.getLogger(__name__)

HOLD_WH = 1.0
SAME_MOMENT_S = 3.0
"""Its clock shows whole seconds."""


class OpenevseStation(WebStation):
    """Implements StationDriver.

    Args:
        settings: Where it is.
        memory: Keeps a limit of somebody else that has to give way to a hold.
    """

    def __init__(self, settings: OpenevseSettings, memory: StationMemory) -> None:
        secret = settings.password
        auth = httpx.BasicAuth(settings.user, secret.get_secret_value()) if secret else None
        super().__init__(WebDevice("OpenEVSE", settings.url, settings.timeout_s, auth))
        self.push = LoadWatch(settings)
        self._pushes = settings.push
        self._memory = memory
        self._limit_name = f"openevse {settings.url} limit"
        self._clock = ClockWatch(self.name, SAME_MOMENT_S)
        self._current_a: int | None = None

    @property
    def capabilities(self) -> StationCapabilities:
        """The latch is the car's business, not the station's."""
        return StationCapabilities(
            switches=True, holds=True, unlocks=False, limits_current=True, **self._web.bounds(2, 6)
        )

    async def open(self) -> None:
        """Connect; see WebStation."""
        if self._pushes:
            self.push.start()
        await super().open()

    async def close(self) -> None:
        """Disconnect; the station goes on by itself. Safe to call twice."""
        await self.push.close()
        await super().close()

    async def _look(self) -> None:
        await self._web.read(Status, "/status")

    async def snapshot(self) -> StationSnapshot:
        """Read the station now.

        Raises:
            StationError: see drivers/station/errors.py.
        """
        limit, _ = await self._web.read(Limit, "/limit")
        status, asked_s = await self._web.read(Status, "/status")
        self._clock.check(status.time, asked_s)
        return StationSnapshot(
            sampled_at_s=asked_s,
            pilot=status.pilot(self.name),
            enabled=status.enabled,
            held=_is_ours(limit),
            contactor_closed=status.contactor_closed or self.push.load_seen_s > asked_s,
            connector_locked=None,
            power_w=abs(status.power),
            currents_a=(status.current_a, 0.0, 0.0),
            session_energy_wh=status.session_energy,
        )

    async def start(self) -> None:
        """Allow power.

        Raises:
            StationHeldError: a hold of ours is in force.
        """
        if _is_ours((await self._web.read(Limit, "/limit"))[0]):
            raise StationHeldError(f"{self.name} is held; release it before it may give power.")
        await self._override("active", auto_release=True)

    async def stop(self) -> None:
        """Forbid power; the snapshot shows when it has really gone."""
        await self._override("disabled", auto_release=False)

    async def hold(self) -> None:
        """Keep the power off with a limit that is already reached.

        Raises:
            StationRefusedError: the limit is not there after it was set.
        """
        limit, _ = await self._web.read(Limit, "/limit")
        if not _is_ours(limit):
            foreign = limit.model_dump_json() if limit.type != "none" else None
            await self._memory.put(self._limit_name, foreign)
            ours: dict[str, JsonValue] = {
                "type": "energy",
                "value": int(HOLD_WH),
                "auto_release": True,
            }
            await self._web.call("POST", "/limit", json=ours)
        status, _ = await self._web.read(Status, "/status")
        if status.session_energy < HOLD_WH:
            _log.info("the hold of the OpenEVSE bites after 1 Wh; until then an override keeps it")
            await self.stop()
        if not _is_ours((await self._web.read(Limit, "/limit"))[0]):
            raise StationRefusedError(
                f"{self.name} did not keep the hold. Bring its firmware up to date (4.2 or later)."
            )

    async def release(self) -> None:
        """End the hold. With a car connected the power stays off until somebody enables it."""
        status, _ = await self._web.read(Status, "/status")
        limit, _ = await self._web.read(Limit, "/limit")
        override, _ = await self._web.read(Override, "/override")
        connected = status.pilot(self.name) is not PilotState.A
        if connected:
            # It ends by itself when the car is disconnected.
            await self._override("disabled", auto_release=True)
        if _is_ours(limit):
            await self._end_limit()
        if not connected and override.state is not None:
            await self._web.call("DELETE", "/override")

    async def unlock(self) -> None:
        """The station has no lock.

        Raises:
            StationUnsupportedError: always.
        """
        raise StationUnsupportedError(f"{self.name} has no lock: open it from the car.")

    async def limit_current(self, current_a: float) -> None:
        """It takes whole amperes, as part of the override that is there."""
        self._current_a = math.floor(current_a)
        override, _ = await self._web.read(Override, "/override")
        await self._override(override.state, auto_release=override.auto_release)

    def listen(self, listener: Callable[[], None]) -> None:
        """Call ``listener`` with every push that shows something else than the one before."""
        self.push.listen(listener)

    async def _end_limit(self) -> None:
        foreign = await self._memory.get(self._limit_name)
        if foreign is None:
            await self._web.call("DELETE", "/limit")
            return
        theirs = self._web.parse(Limit, foreign)
        await self._web.call("POST", "/limit", json=theirs.model_dump())
        await self._memory.put(self._limit_name, None)

    async def _override(self, state: str | None, *, auto_release: bool) -> None:
        """Write the one override that there is, so with everything that it should hold."""
        wanted: dict[str, JsonValue] = {"auto_release": auto_release}
        if state is not None:
            wanted["state"] = state
        if self._current_a is not None:
            wanted["charge_current"] = self._current_a
        await self._web.call("POST", "/override", json=wanted)


def _is_ours(limit: Limit) -> bool:
    return limit.type == "energy" and limit.value == HOLD_WH
