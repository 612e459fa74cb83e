"""Keeps the settings that were changed while PlugPilot ran."""

from __future__ import annotations

from pydantic import JsonValue
from sqlalchemy.orm import Session

from server.storage.database import Database
from server.storage.integration_tables import ChangedSettingsRow

ONLY_ROW = 1


class ChangedSettingsStore:
    """Sections with the settings that were changed, and nothing else."""

    def __init__(self, database: Database) -> None:
        self._database = database

    async def load(self) -> dict[str, dict[str, JsonValue]]:
        """All changes; empty without any."""

        def work(session: Session) -> dict[str, dict[str, JsonValue]]:
            row = session.get(ChangedSettingsRow, ONLY_ROW)
            return {} if row is None else row.values

        return await self._database.run(work)

    async def save(self, changes: dict[str, dict[str, JsonValue]]) -> None:
        """Keep all changes; on disk when this returns."""

        def work(session: Session) -> None:
            session.merge(ChangedSettingsRow(id=ONLY_ROW, values=changes))

        await self._database.run(work)
