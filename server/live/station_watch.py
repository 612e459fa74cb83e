"""Reads the charging station regularly, for people to see."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import Callable

from drivers.station import (
    StationCapabilities,
    StationDriver,
    StationError,
    StationSnapshot,
)

_log = logging.getLogger(__name__)


NEWS_PAUSE_S = 0.1
"""Whatever a station tells by itself, it is read no more often than this."""


class StationWatch:
    """Knows the newest reading and whether the station answers.

    It reads regularly, and at once when the station tells by itself that something has changed.
    Decisions about pulling the plug never rest on this: they take fresh samples themselves.

    Args:
        station: The station.
        period_s: Longest event loop time between readings.
        changed: Called after every reading.
    """

    def __init__(
        self, station: StationDriver, period_s: float, changed: Callable[[], None]
    ) -> None:
        self.snapshot: StationSnapshot | None = None
        self.online = False
        self._station = station
        self._period_s = period_s
        self._changed = changed
        self._task: asyncio.Task[None] | None = None
        self._news = asyncio.Event()
        station.listen(self._news.set)

    @property
    def capabilities(self) -> StationCapabilities:
        """What the station can do."""
        return self._station.capabilities

    @property
    def name(self) -> str:
        """Name of the station."""
        return self._station.name

    async def start(self) -> None:
        """Read once, then keep reading."""
        await self._read()
        self._task = asyncio.create_task(self._run(), name="station watch")

    async def close(self) -> None:
        """Stop reading."""
        if self._task is not None:
            self._task.cancel()
            await asyncio.wait([self._task])

    async def _run(self) -> None:
        while True:
            pause_s = min(NEWS_PAUSE_S, self._period_s)
            await asyncio.sleep(pause_s)
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(self._period_s - pause_s):
                    await self._news.wait()
            # Cleared before the question: what happens from here on is news again.
            self._news.clear()
            await self._read()

    async def _read(self) -> None:
        try:
            self.snapshot = await self._station.snapshot()
        except StationError as error:
            if self.online:
                _log.warning("the charging station does not answer: %s", error)
            self.online = False
        else:
            self.online = True
        self._changed()
