"""Keeps calibrations, and which one counts."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from typing import Any

from sqlalchemy import Select, func, select
from sqlalchemy.orm import Session

from server.storage.calibration_tables import CalibrationRow, CalibrationUseRow
from server.storage.database import Database

WHOLE_ROBOT = ""


@dataclass(frozen=True, slots=True)
class StoredCalibration:
    """One version as it is kept.

    Attributes:
        id: UUID of version 7.
        kind: Of what.
        made_at: When.
        made_by: Who.
        source: Where its numbers come from.
        grade: Of its verdict.
        remarks: Of its verdict.
        content: The numbers.
        evidence: What they rest on.
        error: What it misses on data held back.
        error_in_use: What the one then in force missed on the same data.
        version: Counted for each kind; 0 until it is kept.
        subject: Of a vehicle's socket the vehicle.
    """

    id: str
    kind: str
    made_at: datetime
    made_by: str
    source: str
    grade: str
    remarks: list[str]
    content: dict[str, Any]
    evidence: dict[str, Any] | None
    error: float | None
    error_in_use: float | None
    version: int = 0
    subject: str = WHOLE_ROBOT


class CalibrationStore:
    """All calibrations.

    Args:
        database: Where they are kept.
    """

    def __init__(self, database: Database) -> None:
        self._database = database

    async def add(self, calibration: StoredCalibration) -> StoredCalibration:
        """Keep a new version; returns it with its number."""

        def work(session: Session) -> StoredCalibration:
            newest = session.scalar(
                select(func.max(CalibrationRow.version)).where(
                    CalibrationRow.kind == calibration.kind,
                    CalibrationRow.subject == calibration.subject,
                )
            )
            row = CalibrationRow(**_columns(calibration, (newest or 0) + 1))
            session.add(row)
            return _stored(row)

        return await self._database.run(work)

    async def get(self, calibration_id: str) -> StoredCalibration | None:
        """One version, or None."""

        def work(session: Session) -> StoredCalibration | None:
            row = session.get(CalibrationRow, calibration_id)
            return None if row is None else _stored(row)

        return await self._database.run(work)

    async def page(
        self, *, kind: str | None, before: str | None, limit: int
    ) -> list[StoredCalibration]:
        """Versions, newest first; one more than the limit where there are more."""

        def work(session: Session) -> list[StoredCalibration]:
            query = select(CalibrationRow).order_by(CalibrationRow.id.desc()).limit(limit + 1)
            if kind is not None:
                query = query.where(CalibrationRow.kind == kind)
            if before is not None:
                query = query.where(CalibrationRow.id < before)
            return [_stored(row) for row in session.scalars(query)]

        return await self._database.run(work)

    async def in_force(self) -> list[StoredCalibration]:
        """The version of each kind and subject that counts now, where there is one."""

        def work(session: Session) -> list[StoredCalibration]:
            newest = (
                select(func.max(CalibrationUseRow.sequence))
                .where(CalibrationUseRow.undone_at.is_(None))
                .group_by(CalibrationUseRow.kind, CalibrationUseRow.subject)
            )
            query = (
                select(CalibrationRow)
                .join(CalibrationUseRow, CalibrationUseRow.calibration_id == CalibrationRow.id)
                .where(CalibrationUseRow.sequence.in_(newest))
            )
            return [_stored(row) for row in session.scalars(query)]

        return await self._database.run(work)

    async def use(self, calibration: StoredCalibration, at: datetime, by: str) -> None:
        """From now on this version counts."""

        def work(session: Session) -> None:
            last = session.scalar(select(func.max(CalibrationUseRow.sequence)))
            session.add(
                CalibrationUseRow(
                    sequence=(last or 0) + 1,
                    kind=calibration.kind,
                    subject=calibration.subject,
                    calibration_id=calibration.id,
                    since=at,
                    by=by,
                    undone_at=None,
                    undone_by=None,
                )
            )

        await self._database.run(work)

    async def before(self, kind: str, subject: str = WHOLE_ROBOT) -> StoredCalibration | None:
        """What counted before the version that counts now; None: what is configured."""

        def work(session: Session) -> StoredCalibration | None:
            uses = session.scalars(_uses(kind, subject).offset(1).limit(1)).first()
            row = session.get(CalibrationRow, uses.calibration_id) if uses else None
            return None if row is None else _stored(row)

        return await self._database.run(work)

    async def undo(self, kind: str, at: datetime, by: str, subject: str = WHOLE_ROBOT) -> None:
        """The version that counts now does not count any more; the one before it does."""

        def work(session: Session) -> None:
            newest = session.scalars(_uses(kind, subject).limit(1)).first()
            if newest is not None:
                newest.undone_at, newest.undone_by = at, by

        await self._database.run(work)


def _uses(kind: str, subject: str) -> Select[CalibrationUseRow]:
    """What was put in force and not undone, the newest first."""
    return (
        select(CalibrationUseRow)
        .where(
            CalibrationUseRow.kind == kind,
            CalibrationUseRow.subject == subject,
            CalibrationUseRow.undone_at.is_(None),
        )
        .order_by(CalibrationUseRow.sequence.desc())
    )


_NAMES = (
    "id", "kind", "subject", "made_at", "made_by", "source", "grade", "remarks", "content",
    "evidence", "error", "error_in_use",
)  # fmt: skip


def _columns(calibration: StoredCalibration, version: int) -> dict[str, Any]:
    return {**{name: getattr(calibration, name) for name in _NAMES}, "version": version}


def _stored(row: CalibrationRow) -> StoredCalibration:
    return StoredCalibration(**{name: getattr(row, name) for name in (*_NAMES, "version")})
