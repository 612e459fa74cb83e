"""Keeps what calibration remembers between two starts: one note of each name."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from sqlalchemy.orm import Session

from server.storage.calibration_tables import CalibrationNoteRow
from server.storage.database import Database


class CalibrationNotes:
    """Notes by name.

    Args:
        database: Where they are kept.
    """

    def __init__(self, database: Database) -> None:
        self._database = database

    async def read(self, name: str) -> dict[str, Any] | None:
        """The newest note of that name, or None."""

        def work(session: Session) -> dict[str, Any] | None:
            row = session.get(CalibrationNoteRow, name)
            return None if row is None else dict(row.content)

        return await self._database.run(work)

    async def write(self, name: str, content: dict[str, Any], at: datetime) -> None:
        """Keep a note in place of the last one of that name."""

        def work(session: Session) -> None:
            session.merge(CalibrationNoteRow(name=name, written_at=at, content=content))

        await self._database.run(work)
