"""Keeps the settings that were changed while PlugPilot ran, and what they were before."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime

from pydantic import JsonValue
from sqlalchemy import select
from sqlalchemy.orm import Session

from server.storage.database import Database
from server.storage.integration_tables import ChangedSettingsRow

ONLY_ROW = 1
"""What holds. Rows with higher numbers are versions, in order."""

VERSIONS_KEPT = 50

Changes = dict[str, dict[str, JsonValue]]


@dataclass(frozen=True, slots=True)
class SettingsVersion:
    """What was changed since the start, after one change.

    Attributes:
        number: Grows with each.
        at: When it was made.
        by: Who made it.
        changes: All changes that held then.
    """

    number: int
    at: datetime
    by: str
    changes: Changes


class ChangedSettingsStore:
    """Sections with the settings that were changed, and nothing else."""

    def __init__(self, database: Database) -> None:
        self._database = database

    async def load(self) -> Changes:
        """All changes; empty without any."""

        def work(session: Session) -> Changes:
            row = session.get(ChangedSettingsRow, ONLY_ROW)
            return {} if row is None else row.values

        return await self._database.run(work)

    async def save(self, changes: Changes, at: datetime | None = None, by: str = "") -> None:
        """Keep all changes; on disk when this returns.

        Args:
            changes: All that hold.
            at: When they were made; None keeps no version of them.
            by: Who made them.
        """

        def work(session: Session) -> None:
            session.merge(ChangedSettingsRow(id=ONLY_ROW, values=changes))
            if at is not None:
                kept = select(ChangedSettingsRow.id).where(ChangedSettingsRow.id > ONLY_ROW)
                numbers = sorted(session.scalars(kept))
                number = max([ONLY_ROW, *numbers]) + 1
                values = {"at": at.isoformat(), "by": by, "changes": changes}
                session.add(ChangedSettingsRow(id=number, values=values))
                for old in numbers[: max(len(numbers) + 1 - VERSIONS_KEPT, 0)]:
                    session.delete(session.get_one(ChangedSettingsRow, old))

        await self._database.run(work)

    async def versions(self) -> list[SettingsVersion]:
        """What is kept of the past, the newest first."""

        def work(session: Session) -> list[SettingsVersion]:
            rows = select(ChangedSettingsRow).where(ChangedSettingsRow.id > ONLY_ROW)
            return [
                SettingsVersion(
                    number=row.id,
                    at=datetime.fromisoformat(row.values["at"]),
                    by=row.values["by"],
                    changes=row.values["changes"],
                )
                for row in session.scalars(rows.order_by(ChangedSettingsRow.id.desc()))
            ]

        return await self._database.run(work)
