"""Sees to it that a copy is made every day, also while PlugPilot runs for weeks."""

from __future__ import annotations

import asyncio

from server.storage.database import Database
from server.timing import Calendar

LOOK_S = 3600.0
"""So often it is looked whether a copy is due; one that has failed is tried again."""


class DailyBackups:
    """Makes the copies that fall due after the start; the start makes its own.

    Args:
        database: What is copied.
        calendar: Dates of the copies.
    """

    def __init__(self, database: Database, calendar: Calendar) -> None:
        self._database = database
        self._calendar = calendar
        self._task: asyncio.Task[None] | None = None

    def start(self) -> None:
        """Look regularly from now on."""
        self._task = asyncio.create_task(self._run(), name="daily backups")

    async def close(self) -> None:
        """Look no more. A copy under way is finished by its thread."""
        if self._task is not None:
            self._task.cancel()
            await asyncio.wait([self._task])

    async def _run(self) -> None:
        while True:
            await asyncio.sleep(LOOK_S)
            await self._database.back_up_if_due(self._calendar.now())
