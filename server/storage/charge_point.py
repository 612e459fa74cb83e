"""Keeps what was last wanted of the charge point, and its energy counter."""

from __future__ import annotations

from dataclasses import asdict, dataclass

from sqlalchemy.orm import Session

from server.schema.charge_point import RestReason
from server.storage.database import Database
from server.storage.integration_tables import ChargePointRow

ONLY_ROW = 1


@dataclass(frozen=True, slots=True)
class ChargePointRecord:
    """What a restart must not forget.

    Attributes:
        enabled: What was asked for last.
        resting: Why it waits for a person, if it does.
        failures: Jobs of the energy manager that have failed in a row.
        max_current_a: What was asked for last.
        job_id: The job that the energy manager has begun, or paused, last.
        energy_wh: All energy up to the reading below [Wh].
        session_wh: The session's energy when the station was counted last [Wh].
    """

    enabled: bool = False
    resting: RestReason | None = None
    failures: int = 0
    max_current_a: float | None = None
    job_id: str | None = None
    energy_wh: float = 0.0
    session_wh: float = 0.0


class ChargePointStore:
    """One record."""

    def __init__(self, database: Database) -> None:
        self._database = database

    async def load(self) -> ChargePointRecord:
        """The last record, or a new one."""

        def work(session: Session) -> ChargePointRecord:
            row = session.get(ChargePointRow, ONLY_ROW)
            if row is None:
                return ChargePointRecord()
            return ChargePointRecord(
                enabled=row.enabled,
                resting=row.resting,  # type: ignore[arg-type]  # written from the same words
                failures=row.failures,
                max_current_a=row.max_current_a,
                job_id=row.job_id,
                energy_wh=row.energy_wh,
                session_wh=row.session_wh,
            )

        return await self._database.run(work)

    async def save(self, record: ChargePointRecord) -> None:
        """Keep a record; on disk when this returns."""

        def work(session: Session) -> None:
            session.merge(ChargePointRow(id=ONLY_ROW, **asdict(record)))

        await self._database.run(work)
