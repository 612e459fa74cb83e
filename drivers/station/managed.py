"""An energy manager in front of a station, in the order that keeps the plug safe.

A manager enables a stopped station again within a second. So it is switched off first, then the
station is held; on the way back the station is released first, then the manager gets its mode back.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import replace

from drivers.station.errors import (
    StationHeldError,
    StationSilentError,
    StationUnsupportedError,
)
from drivers.station.protocol import StationCapabilities, StationDriver, StationSnapshot

LOOK_AGAIN_S = 0.25


class ManagedStation:
    """Implements StationDriver on a manager and the station behind it.

    Only the station says whether there is a load; the manager only says whether it is off.

    Args:
        manager: Such as evcc. Its snapshot is enabled as long as it may enable the station.
        station: What gives the power.
        lets_go_s: Switched off, the manager must have stopped enabling within this time [s].
    """

    def __init__(
        self, manager: StationDriver, station: StationDriver, *, lets_go_s: float = 10.0
    ) -> None:
        self._manager = manager
        self._station = station
        self._lets_go_s = lets_go_s

    @property
    def name(self) -> str:
        """Name a person recognises."""
        return f"{self._station.name} with {self._manager.name}"

    @property
    def capabilities(self) -> StationCapabilities:
        """Those of the station. With its only rival off, a switched-off station is held."""
        own, manager = self._station.capabilities, self._manager.capabilities
        waiting_s = self._lets_go_s + LOOK_AGAIN_S + manager.reads_within_s
        return replace(
            own,
            holds=own.holds or own.switches,
            limits_current=False,  # the manager decides that all the time
            reads_within_s=manager.reads_within_s + own.reads_within_s,
            acts_within_s=manager.acts_within_s + waiting_s + own.acts_within_s,
        )

    async def open(self) -> None:
        """Connect to both, even if one is not there.

        Raises:
            StationError: of the one that is not.
        """
        try:
            await self._manager.open()
        finally:
            await self._station.open()

    async def close(self) -> None:
        """Disconnect from both. Safe to call twice."""
        try:
            await self._station.close()
        finally:
            await self._manager.close()

    async def snapshot(self) -> StationSnapshot:
        """Read both now; unknown if one of them is.

        Raises:
            StationError: one of them does not answer.
        """
        manager = await self._manager.snapshot()
        station = await self._station.snapshot()
        return replace(
            station,
            enabled=station.enabled or manager.enabled,
            held=station.held or manager.held,
        )

    async def start(self) -> None:
        """Make the station neutral and let the manager decide.

        Raises:
            StationHeldError: a hold of ours is in force.
        """
        if (await self.snapshot()).held:
            raise StationHeldError(f"{self.name} is held; release it before it may give power.")
        await self._station.release()
        await self._manager.start()

    async def stop(self) -> None:
        """Manager off, then the station."""
        await self._manager.stop()
        await self._station.stop()

    async def hold(self) -> None:
        """Manager off, wait until it has let go, then a hold at the station.

        Raises:
            StationSilentError: the manager goes on enabling the station.
        """
        await self._manager.hold()
        await self._until_manager_lets_go()
        await self._station.hold()

    async def release(self) -> None:
        """Release the station, then give the manager its mode back."""
        await self._station.release()
        await self._manager.release()

    async def unlock(self) -> None:
        """Open the connector lock of the station."""
        await self._station.unlock()

    async def limit_current(self, current_a: float) -> None:
        """The manager would change it again at once.

        Raises:
            StationUnsupportedError: always.
        """
        raise StationUnsupportedError(
            f"{self._manager.name} decides about the current: limit it to {current_a:g} A there."
        )

    def listen(self, listener: Callable[[], None]) -> None:
        """Call ``listener`` with the news of both."""
        self._manager.listen(listener)
        self._station.listen(listener)

    async def _until_manager_lets_go(self) -> None:
        loop = asyncio.get_running_loop()
        deadline_s = loop.time() + self._lets_go_s
        while (await self._manager.snapshot()).enabled:
            if loop.time() > deadline_s:
                raise StationSilentError(
                    f"{self._manager.name} was switched off but has enabled the station for "
                    f"another {self._lets_go_s:g} s. Switch it off in its own page."
                )
            await asyncio.sleep(LOOK_AGAIN_S)
