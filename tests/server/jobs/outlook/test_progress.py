"""What a journal tells, and in whose seconds."""

from __future__ import annotations

import pytest

from server.jobs.journal import Journal
from server.jobs.model import JobPhase
from server.jobs.outlook.progress import Progress
from server.schema.jobs import JobEvent
from server.storage.database import Database
from server.storage.jobs import JobStore
from server.timing import Calendar
from tests.support.jobs import job_of


@pytest.mark.parametrize("speed", [1.0, 10.0])
async def test_the_journal_of_a_fast_simulator_says_how_fast_it_was(speed: float) -> None:
    database, calendar = Database(None), Calendar(speed)
    written: list[JobEvent | None] = []
    await database.open()
    try:
        job = job_of(calendar.now())
        await JobStore(database).add(job, key=None, digest=None)

        def note(_: object, event: JobEvent | None) -> None:
            written.append(event)

        await Journal(job, JobStore(database), calendar, note).begin(JobPhase.PARKING, "Parking.")
        [event] = await JobStore(database).events(job.id)
    finally:
        await database.close()
    assert written == [event]
    stage = Progress().after(event).stage
    assert stage is not None
    assert (stage.phase, stage.clock_speed) == (JobPhase.PARKING, speed)
    assert stage.began_at == event.at
