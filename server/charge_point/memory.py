"""The record of the charge point: in memory at once, on the disk soon after."""

from __future__ import annotations

import asyncio
import logging

from server.storage.charge_point import ChargePointRecord, ChargePointStore
from server.storage.errors import StorageError

_log = logging.getLogger(__name__)

RETRY_S = 30.0


class RecordKeeper:
    """Writes the newest record whenever it has changed.

    Args:
        store: Where it is kept.
    """

    def __init__(self, store: ChargePointStore) -> None:
        self.record = ChargePointRecord()
        self._store = store
        self._changed = asyncio.Event()
        self._task: asyncio.Task[None] | None = None

    async def start(self) -> None:
        """Read the record, and write it from now on."""
        self.record = await self._store.load()
        self._task = asyncio.create_task(self._write_all(), name="charge point record")

    async def close(self) -> None:
        """Write what has changed, and stop."""
        if self._task is None:
            return
        self._task.cancel()
        await asyncio.wait([self._task])
        await self._write()

    def keep(self, record: ChargePointRecord, *, soon: bool = True) -> None:
        """Take over a record.

        Args:
            record: What is so now.
            soon: Write it; else it may wait for the next change that matters.
        """
        if record != self.record:
            self.record = record
            if soon:
                self._changed.set()

    async def _write_all(self) -> None:
        while True:
            await self._changed.wait()
            self._changed.clear()
            if not await self._write():
                await asyncio.sleep(RETRY_S)
                self._changed.set()

    async def _write(self) -> bool:
        try:
            await self._store.save(self.record)
        except StorageError as error:
            _log.warning("the charge point cannot be kept: %s", error)
            return False
        return True
