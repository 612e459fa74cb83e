"""A database that cannot be used: the robot can be unplugged all the same, and this is told."""

from __future__ import annotations

import errno
import sqlite3
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest
from sqlalchemy import text
from sqlalchemy.orm import Session

from server.control.model import PlugState
from server.control.plug_guard import PlugRecord
from server.jobs.model import JobPhase, JobState, JobType
from server.schema.jobs import Job, JobEvent
from server.storage import engines
from server.storage.backups import back_up
from server.storage.database import RETRY_S
from server.storage.errors import (
    DatabaseBrokenError,
    DatabaseBusyError,
    DiskFullError,
    LostDatabaseError,
    StorageError,
)
from server.storage.jobs import JobStore
from server.storage.plug import StoredPlug
from server.storage.plug_file import FILE_NAME as PLUG_FILE
from server.storage.plug_file import PlugFile
from server.storage.sqlite_home import FILE_NAME
from tests.server.storage.samples import event, healthy, job, opened
from tests.support.virtual import run_virtual, wait_until

INSERTED = PlugRecord(PlugState.INSERTED, None)
FREE = PlugRecord(PlugState.FREE, None)

SOON_S = 3 * RETRY_S


def flipped(data: bytes) -> bytes:
    """One bit of the head of every page of the tables is wrong."""
    spoilt = bytearray(data)
    for start in range(4096, len(data), 4096):
        spoilt[start] ^= 0x40
    return bytes(spoilt)


DAMAGES = [
    pytest.param(lambda _: b"shopping list\n" * 1000, id="another file"),
    pytest.param(lambda data: data[: len(data) // 2], id="cut off"),
    pytest.param(lambda data: data[:4096] + b"\x55" * (len(data) - 4096), id="overwritten"),
    pytest.param(lambda data: data[:100] + b"\xff" * 300 + data[400:], id="first page"),
    pytest.param(flipped, id="flipped bits"),
]


def in_phase(number: int, phase: JobPhase, job_type: JobType = JobType.CHARGE) -> Job:
    return job(number).model_copy(update={"phase": phase, "type": job_type})


def begins(sequence: int, phase: JobPhase) -> JobEvent:
    return event(sequence).model_copy(update={"kind": "phase_started", "phase": phase})


def fill_up(session: Session) -> None:
    """Let the file have no more pages, as on a full disk."""
    used = session.scalar(text("PRAGMA page_count"))
    session.execute(text(f"PRAGMA max_page_count = {used}"))


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_damaged_file_is_left_alone_and_told(
    tmp_path: Path, damage: Callable[[bytes], bytes]
) -> None:
    file = healthy(tmp_path)
    spoilt = damage(file.read_bytes())
    file.write_bytes(spoilt)

    async def scenario() -> None:
        database = await opened(tmp_path)
        assert isinstance(database.problem, DatabaseBrokenError)
        assert FILE_NAME in database.problem.detail
        assert "plugpilot restore" in database.problem.remedy
        jobs = JobStore(database)
        assert await jobs.unfinished() == []
        with pytest.raises(DatabaseBrokenError):
            await jobs.add(job(200), key=None, digest=None)
        unplug = in_phase(201, JobPhase.PREFLIGHT, JobType.UNPLUG)
        await jobs.add(unplug, key=None, digest=None)
        for number, phase in enumerate((JobPhase.WITHDRAWING, JobPhase.PARKING), start=1):
            unplug = in_phase(201, phase, JobType.UNPLUG)
            await jobs.save(unplug, begins(number, phase))
        assert await jobs.get(unplug.id) == unplug
        assert len(await jobs.events(unplug.id)) == 2
        await database.close()

    run_virtual(scenario())
    assert file.read_bytes() == spoilt


def test_the_newest_backup_is_offered(tmp_path: Path) -> None:
    file = healthy(tmp_path)
    backup = tmp_path / "backups" / "plugpilot-2026.sqlite3"
    backup.parent.mkdir()
    back_up(file, backup)
    file.write_bytes(b"shopping list\n" * 1000)

    async def scenario() -> None:
        database = await opened(tmp_path)
        assert database.problem is not None
        assert database.problem.context["backup"] == str(backup)
        assert str(backup) in database.problem.detail
        await database.close()

    run_virtual(scenario())


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_damaged_database_does_not_lose_the_plug(
    tmp_path: Path, damage: Callable[[bytes], bytes]
) -> None:
    async def before() -> None:
        database = await opened(tmp_path)
        await StoredPlug(database, tmp_path).save(INSERTED)
        await database.close()

    async def after() -> PlugRecord | None:
        database = await opened(tmp_path)
        plug = await StoredPlug(database, tmp_path).load()
        await database.close()
        return plug

    healthy(tmp_path)
    run_virtual(before())
    file = tmp_path / FILE_NAME
    file.write_bytes(damage(file.read_bytes()))
    assert run_virtual(after()) == INSERTED
    (tmp_path / PLUG_FILE).unlink()
    lost = run_virtual(after())
    assert lost is not None
    assert lost.state is PlugState.UNKNOWN, "with neither of them nobody knows"


def test_a_database_that_breaks_while_it_is_used_is_replaced_by_memory(tmp_path: Path) -> None:
    file = healthy(tmp_path)

    async def scenario() -> None:
        database = await opened(tmp_path)
        jobs = JobStore(database)
        charging = in_phase(1, JobPhase.CHARGING)
        await jobs.save(charging, begins(1, JobPhase.CHARGING))

        await database.run(lambda session: session.execute(text("PRAGMA cache_size = 0")))
        with closing(sqlite3.connect(file)) as other:
            other.execute("PRAGMA wal_checkpoint(TRUNCATE)")
        file.write_bytes(file.read_bytes()[:4096] + b"\x55" * (file.stat().st_size - 4096))
        releasing = in_phase(1, JobPhase.RELEASING)
        await jobs.save(releasing, begins(2, JobPhase.RELEASING))
        assert isinstance(database.problem, DatabaseBrokenError)
        assert await jobs.get(releasing.id) == releasing
        await database.close()

    run_virtual(scenario())


def test_without_room_nothing_new_begins_and_what_is_out_comes_home(tmp_path: Path) -> None:
    told: list[LostDatabaseError | None] = []

    async def scenario() -> None:
        database = await opened(tmp_path)
        database.listen(lambda: told.append(database.problem))
        jobs = JobStore(database)
        await jobs.add(job(1), key=None, digest=None)
        await jobs.add(job(2), key=None, digest=None)
        await jobs.save(in_phase(2, JobPhase.CHARGING), begins(1, JobPhase.CHARGING))
        await database.run(fill_up)
        sequence = 0
        while database.problem is None:  # a page has room for some more
            sequence += 1
            await jobs.save(job(1), event(sequence, "x" * 500))
        assert isinstance(database.problem, DiskFullError)
        assert "sqlalche" not in database.problem.detail, "words for people"
        assert len(await jobs.events(job(1).id)) == sequence, "what was kept before can be read"

        with pytest.raises(DiskFullError):
            await jobs.save(in_phase(1, JobPhase.INSERTING), begins(99, JobPhase.INSERTING))
        with pytest.raises(DiskFullError):
            await jobs.add(job(3), key=None, digest=None)
        for number, phase in enumerate((JobPhase.RELEASING, JobPhase.WITHDRAWING), start=2):
            await jobs.save(in_phase(2, phase), begins(number, phase))
        failed = job(1, JobState.FAILED)
        await jobs.save(failed, event(sequence + 1))
        unplug = in_phase(4, JobPhase.PREFLIGHT, JobType.UNPLUG)
        await jobs.add(unplug, key="again", digest="digest")

        # a new connection has no limit any more: somebody has made room
        await wait_until(lambda: database.problem is None, timeout_s=SOON_S)
        await database.close()
        database = await opened(tmp_path)
        jobs = JobStore(database)
        assert await jobs.get(failed.id) == failed
        assert await jobs.get(job(3).id) is None
        assert await jobs.by_key("again") == (unplug, "digest")
        phases = [found.phase for found in await jobs.events(job(2).id)]
        assert phases == [JobPhase.CHARGING, JobPhase.RELEASING, JobPhase.WITHDRAWING]
        assert len(await jobs.events(job(1).id)) == sequence + 1
        await database.close()

    run_virtual(scenario())
    assert isinstance(told[0], DiskFullError)
    assert told[-1] is None
    assert len(told) == 2


def test_from_the_way_in_a_job_does_not_go_on_without_a_disk(tmp_path: Path) -> None:
    async def scenario() -> None:
        database = await opened(tmp_path)
        jobs = JobStore(database)
        await jobs.add(job(1), key=None, digest=None)
        await jobs.save(in_phase(1, JobPhase.INSERTING), begins(1, JobPhase.INSERTING))
        await database.run(fill_up)
        sequence = 1
        while database.problem is None:
            sequence += 1
            await jobs.save(in_phase(1, JobPhase.INSERTING), event(sequence, "x" * 500))
        with pytest.raises(DiskFullError):
            await jobs.save(in_phase(1, JobPhase.PLUGGED), begins(999, JobPhase.PLUGGED))
        await database.close()

    run_virtual(scenario())


@pytest.mark.parametrize("how", ["IMMEDIATE", "EXCLUSIVE"])
def test_a_database_that_another_program_holds_is_waited_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, how: str
) -> None:
    monkeypatch.setattr(engines, "BUSY_MS", 20)
    healthy(tmp_path)

    async def scenario(other: sqlite3.Connection) -> None:
        database = await opened(tmp_path)
        jobs = JobStore(database)
        other.execute(f"BEGIN {how}")
        noted = in_phase(1, JobPhase.CHARGING)
        await jobs.save(noted, event(1))
        assert isinstance(database.problem, DatabaseBusyError)
        assert await jobs.get(noted.id) == noted
        assert await jobs.get(job(2).id) == job(2), "what is on the disk can be read"
        other.execute("ROLLBACK")
        await wait_until(lambda: database.problem is None, timeout_s=SOON_S)
        assert await jobs.get(noted.id) == noted
        await database.close()

    with closing(sqlite3.connect(tmp_path / FILE_NAME, isolation_level=None)) as other:
        run_virtual(scenario(other))


def test_a_database_that_is_held_at_the_start_does_not_keep_the_robot_from_starting(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(engines, "BUSY_MS", 20)
    healthy(tmp_path)

    async def scenario(other: sqlite3.Connection) -> None:
        other.execute("PRAGMA locking_mode = EXCLUSIVE")
        other.execute("BEGIN EXCLUSIVE")
        database = await opened(tmp_path)
        assert isinstance(database.problem, DatabaseBusyError)
        plug = await StoredPlug(database, tmp_path).load()
        assert plug is not None
        assert plug.state is PlugState.UNKNOWN, "nothing could be read, so it is not known"
        other.close()
        await wait_until(lambda: database.problem is None, timeout_s=SOON_S)
        assert await JobStore(database).get(job(2).id) == job(2)
        await database.close()

    run_virtual(scenario(sqlite3.connect(tmp_path / FILE_NAME, isolation_level=None)))


def test_a_free_plug_that_cannot_be_written_down_counts_as_inserted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise OSError(errno.EROFS, "Read-only file system")

    async def scenario() -> None:
        database = await opened(tmp_path)
        plug = StoredPlug(database, tmp_path)
        await plug.save(INSERTED)
        await database.run(fill_up)
        jobs, sequence = JobStore(database), 0
        await jobs.add(job(1), key=None, digest=None)
        while database.problem is None:
            sequence += 1
            await jobs.save(job(1), event(sequence, "x" * 500))
        with monkeypatch.context() as no_file:
            no_file.setattr(PlugFile, "write", refuse)
            await plug.save(FREE)
            with pytest.raises(StorageError, match="full"):
                await plug.save(INSERTED)
        assert await StoredPlug(database, tmp_path).load() is not None

    run_virtual(scenario())
    read = PlugFile(tmp_path).read()
    assert read is not None
    assert read.record == INSERTED
