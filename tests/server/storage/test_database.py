from __future__ import annotations

import subprocess
import sys
from datetime import UTC
from pathlib import Path

import pytest
from sqlalchemy import text
from sqlalchemy.orm import Session

from server.jobs.model import JobState
from server.labels.payload import LabelKey
from server.schema.jobs import Job, JobEvent, JobResult
from server.schema.vehicles import SocketOffset, VehicleSettings
from server.storage.errors import (
    DataFolderError,
    StorageError,
)
from server.storage.jobs import JobStore
from server.storage.sqlite_home import FILE_NAME
from server.storage.vehicles import VehicleStore
from tests.server.storage.samples import NOW, advanced, event, healthy, job, opened
from tests.support.virtual import run_virtual


def refusal(folder: Path) -> StorageError:
    """What opening says."""

    async def scenario() -> None:
        await (await opened(folder)).close()

    with pytest.raises(StorageError) as raised:
        run_virtual(scenario())
    assert raised.value.remedy
    return raised.value


def test_an_empty_file_becomes_a_database(tmp_path: Path) -> None:
    (tmp_path / FILE_NAME).touch()
    healthy(tmp_path)


def test_a_folder_below_a_file_cannot_be_used(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    error = refusal(tmp_path / "file" / "data")
    assert isinstance(error, DataFolderError)
    assert "--data-dir" in error.remedy


def test_a_file_that_cannot_be_opened_says_so(tmp_path: Path) -> None:
    (tmp_path / FILE_NAME).mkdir()
    assert isinstance(refusal(tmp_path), DataFolderError)


def test_the_folder_is_made_and_belongs_to_its_owner_alone(tmp_path: Path) -> None:
    healthy(tmp_path / "a" / "b")
    assert (tmp_path / "a" / "b").stat().st_mode & 0o077 == 0


def test_commits_reach_the_disk_and_not_only_the_systems_memory(tmp_path: Path) -> None:
    """A power cut cannot be tested; that SQLite is told to flush every commit can."""

    async def scenario() -> None:
        database = await opened(tmp_path)

        def modes(session: Session) -> tuple[object, object]:
            return (
                session.scalar(text("PRAGMA synchronous")),
                session.scalar(text("PRAGMA journal_mode")),
            )

        assert await database.run(modes) == (2, "wal")
        await database.close()

    run_virtual(scenario())


WRITER = """
import asyncio, sys
from pathlib import Path
from server.storage.database import Database
from server.storage.jobs import JobStore
from tests.server.storage.samples import advanced, event, job

async def main():
    database = Database(Path(sys.argv[1]))
    await database.open()
    jobs = JobStore(database)
    await jobs.add(job(1), key=None, digest=None)
    for number in range(1, 1_000_000):
        await jobs.save(advanced(number), event(number))
        print(number, flush=True)

asyncio.run(main())
"""


def test_a_process_that_is_killed_loses_nothing_that_was_committed(tmp_path: Path) -> None:
    writer = subprocess.Popen(
        [sys.executable, "-c", WRITER, str(tmp_path)], stdout=subprocess.PIPE, text=True
    )
    assert writer.stdout is not None
    confirmed = 0
    for line in writer.stdout:
        confirmed = int(line)
        if confirmed == 40:
            writer.kill()
            break
    confirmed = max([confirmed, *(int(line) for line in writer.stdout if line.endswith("\n"))])
    writer.stdout.close()
    writer.wait()

    async def scenario() -> tuple[list[JobEvent], Job | None, list[Job]]:
        database = await opened(tmp_path)
        jobs = JobStore(database)
        found = await jobs.events(job(1).id), await jobs.get(job(1).id), await jobs.unfinished()
        await database.close()
        return found

    events, found, unfinished = run_virtual(scenario())
    assert len(events) in {confirmed, confirmed + 1}
    assert [e.sequence for e in events] == list(range(1, len(events) + 1))
    assert found == advanced(len(events)), "the state belongs to the newest event"
    assert [j.id for j in unfinished] == [job(1).id]


def test_the_newest_jobs_that_succeeded_come_first(tmp_path: Path) -> None:
    async def scenario() -> None:
        database = await opened(tmp_path)
        jobs = JobStore(database)
        for number, state in enumerate(
            [JobState.SUCCEEDED, JobState.FAILED, JobState.SUCCEEDED, JobState.SUCCEEDED]
        ):
            await jobs.add(job(number, state), key=None, digest=None)
        found = await jobs.succeeded(2)
        await database.close()
        assert [each.id for each in found] == [job(3).id, job(2).id]

    run_virtual(scenario())


def test_pages_follow_each_other_without_gap_or_repetition(tmp_path: Path) -> None:
    async def scenario() -> None:
        database = await opened(tmp_path)
        jobs = JobStore(database)
        for number in [3, 1, 4, 0, 2, 6, 5]:
            await jobs.add(job(number), key=None, digest=None)
        pages: list[list[str]] = []
        before: str | None = None
        while page := await jobs.page(before=before, limit=3):
            pages.append([j.id[4:8] for j in page])
            before = page[-1].id
            await jobs.add(job(10 + len(pages)), key=None, digest=None)  # newer ones do not disturb
        assert pages == [["0006", "0005", "0004"], ["0003", "0002", "0001"], ["0000"]]
        assert await jobs.page(before="nonsense-sorts-last", limit=1) != []
        await database.close()

    run_virtual(scenario())


def test_a_job_comes_back_as_it_was(tmp_path: Path) -> None:
    async def scenario() -> None:
        database = await opened(tmp_path)
        jobs = JobStore(database)
        await jobs.add(job(1, JobState.QUEUED), key="key", digest="digest")
        assert await jobs.by_key("key") == (job(1, JobState.QUEUED), "digest")
        assert await jobs.by_key("another") is None
        assert await jobs.get("another") is None
        with pytest.raises(StorageError, match="UNIQUE"):
            await jobs.add(job(2), key="key", digest="digest")
        assert await jobs.get(job(2).id) is None
        with pytest.raises(StorageError):
            await jobs.save(job(3), event(1))
        ended = job(1, JobState.SUCCEEDED).model_copy(
            update={"result": JobResult(insertion_depth_mm=40.1), "updated_at": NOW.astimezone(UTC)}
        )
        await jobs.save(ended, event(1))
        assert await jobs.get(job(1).id) == ended
        assert await jobs.unfinished() == []
        assert await jobs.events(job(1).id) == [event(1)]
        assert await jobs.last_sequence(job(1).id) == 1
        assert await jobs.last_sequence(job(2).id) == 0
        with pytest.raises(StorageError):
            await jobs.save(job(1), event(1))
        assert await jobs.get(job(1).id) == ended, "state and event are written together or not"
        await database.close()

    run_virtual(scenario())


def test_vehicles_are_added_changed_sorted_and_forgotten() -> None:
    def settings(name: str) -> VehicleSettings:
        offset = SocketOffset(
            x_mm=120.0, y_mm=0.0, z_mm=0.0, rotation_x_rad=0.0, rotation_y_rad=0.0
        )
        return VehicleSettings(name=name, label_size_mm=60.0, socket=offset)

    async def scenario() -> None:
        database = await opened(None)
        vehicles = VehicleStore(database, LabelKey(bytes(range(32))))
        zoe, is_new = await vehicles.put("zoe", settings("Zoe"))
        assert is_new
        assert zoe.label_payload == "PP2:zoe:4NG43RRFJW"
        await vehicles.put("b", settings("anna's car"))
        again, is_new = await vehicles.put("zoe", settings("Abel"))
        assert not is_new
        assert again.name == "Abel"
        assert [v.id for v in await vehicles.all()] == ["zoe", "b"]
        assert await vehicles.get("zoe") == again
        assert await vehicles.delete("zoe")
        assert not await vehicles.delete("zoe")
        assert await vehicles.get("zoe") is None
        await database.close()

    run_virtual(scenario())
