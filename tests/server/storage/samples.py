"""Jobs and events for tests of storage."""

from __future__ import annotations

from datetime import datetime, timedelta, timezone
from pathlib import Path

from server.jobs.model import JobPhase, JobState
from server.schema.jobs import Job, JobEvent, JobResult
from server.storage.database import Database
from server.storage.jobs import JobStore
from server.storage.sqlite_home import FILE_NAME
from tests.support.jobs import job_of
from tests.support.virtual import run_virtual

NOW = datetime(2026, 3, 1, 12, 0, tzinfo=timezone(timedelta(hours=1)))


def job(number: int, state: JobState = JobState.RUNNING) -> Job:
    return job_of(NOW, id=f"0190{number:04d}-0000-7000-8000-000000000000", state=state)


def event(sequence: int, message: str = "Something happened.") -> JobEvent:
    return JobEvent(
        sequence=sequence,
        at=NOW,
        kind="note",
        phase=JobPhase.PREFLIGHT,
        message=message,
        data={"depth_mm": 1.5},
    )


def advanced(number: int) -> Job:
    """The first job after so many events."""
    return job(1).model_copy(update={"result": JobResult(energy_wh=float(number))})


async def opened(folder: Path | None) -> Database:
    database = Database(folder)
    await database.open()
    return database


def healthy(folder: Path) -> Path:
    """A database with many jobs, closed; returns its file."""

    async def scenario() -> None:
        database = await opened(folder)
        for number in range(30):
            await JobStore(database).add(job(number), key=None, digest=None)
        await database.close()

    run_virtual(scenario())
    return folder / FILE_NAME
