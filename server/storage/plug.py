"""Keeps where the plug is."""

from __future__ import annotations

from dataclasses import asdict

from sqlalchemy.orm import Session

from server.control.model import PlugState
from server.control.plug_guard import Corridor, PlugRecord
from server.storage.database import Database
from server.storage.tables import PlugRow

ONLY_ROW = 1


class StoredPlug:
    """The plug record in the database (the PlugStore of the plug guard)."""

    def __init__(self, database: Database) -> None:
        self._database = database

    async def load(self) -> PlugRecord | None:
        """The last record, or None on a new installation."""

        def work(session: Session) -> PlugRecord | None:
            row = session.get(PlugRow, ONLY_ROW)
            if row is None:
                return None
            corridor = Corridor(**row.corridor) if row.corridor else None
            return PlugRecord(PlugState(row.state), corridor)

        return await self._database.run(work)

    async def save(self, record: PlugRecord) -> None:
        """Write the record down; returns when it is safe on disk."""
        corridor = asdict(record.corridor) if record.corridor else None

        def work(session: Session) -> None:
            session.merge(PlugRow(id=ONLY_ROW, state=record.state.value, corridor=corridor))

        await self._database.run(work)
