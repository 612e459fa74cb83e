"""Keeps nine-point checks."""

from __future__ import annotations

from sqlalchemy import select
from sqlalchemy.orm import Session

from server.schema.accuracy import AccuracyCheck
from server.storage.calibration_tables import AccuracyCheckRow
from server.storage.database import Database


class AccuracyCheckStore:
    """All checks that were ever made.

    Args:
        database: Where they are kept.
    """

    def __init__(self, database: Database) -> None:
        self._database = database

    async def add(self, check: AccuracyCheck) -> None:
        """Keep a check."""

        def work(session: Session) -> None:
            content = check.model_dump(mode="json")
            session.add(AccuracyCheckRow(id=check.id, made_at=check.made_at, content=content))

        await self._database.run(work)

    async def get(self, check_id: str) -> AccuracyCheck | None:
        """One check, or None."""

        def work(session: Session) -> AccuracyCheck | None:
            row = session.get(AccuracyCheckRow, check_id)
            return None if row is None else AccuracyCheck.model_validate(row.content)

        return await self._database.run(work)

    async def page(self, *, before: str | None, limit: int) -> list[AccuracyCheck]:
        """Checks, newest first; one more than the limit where there are more."""

        def work(session: Session) -> list[AccuracyCheck]:
            query = select(AccuracyCheckRow).order_by(AccuracyCheckRow.id.desc()).limit(limit + 1)
            if before is not None:
                query = query.where(AccuracyCheckRow.id < before)
            return [AccuracyCheck.model_validate(row.content) for row in session.scalars(query)]

        return await self._database.run(work)
