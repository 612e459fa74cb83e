"""Backups: whole, one moment, never over another file; and how they come back."""

from __future__ import annotations

import os
import sqlite3
import subprocess
import sys
from contextlib import closing
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest

from server.control.model import PlugState
from server.control.plug_guard import PlugRecord
from server.jobs.model import JobState
from server.storage.backups import BEFORE_UPGRADE, DAILY, Backup, Backups, back_up
from server.storage.errors import (
    BackupError,
    DatabaseBrokenError,
    DatabaseVersionError,
    DiskError,
    FolderInUseError,
    StorageError,
)
from server.storage.folder_lock import holding
from server.storage.jobs import JobStore
from server.storage.plug import StoredPlug
from server.storage.plug_file import FILE_NAME as PLUG_FILE
from server.storage.restoring import begin_anew, restore
from server.storage.sqlite_home import FILE_NAME
from server.storage.upgrade import HEAD
from tests.server.storage.first_release import INTERRUPTED, SUCCEEDED, first_release
from tests.server.storage.samples import advanced, event, healthy, job, opened
from tests.support.virtual import run_virtual


def rows(file: Path) -> list[str]:
    with closing(sqlite3.connect(file)) as connection:
        return list(connection.iterdump())


def test_a_backup_is_made_while_the_database_is_used(tmp_path: Path) -> None:
    async def scenario() -> None:
        database = await opened(tmp_path / "data")
        jobs = JobStore(database)
        await jobs.add(job(1), key=None, digest=None)
        for number in range(1, 20):
            await jobs.save(advanced(number), event(number))
            target = tmp_path / f"{number}.sqlite3"
            back_up(tmp_path / "data" / FILE_NAME, target)
            with closing(sqlite3.connect(target)) as copy:
                assert copy.execute("SELECT count(*) FROM job_events").fetchone() == (number,)
        await database.close()

    run_virtual(scenario())
    assert sorted(path.suffix for path in tmp_path.iterdir()) == ["", *[".sqlite3"] * 19]
    assert (tmp_path / "1.sqlite3").stat().st_mode & 0o077 == 0


WRITER = """
import asyncio, sys
from pathlib import Path
from tests.server.storage.samples import advanced, event, job, opened
from server.storage.jobs import JobStore

async def main():
    jobs = JobStore(await opened(Path(sys.argv[1])))
    await jobs.add(job(1), key=None, digest=None)
    for number in range(1, 1_000_000):
        await jobs.save(advanced(number), event(number))
        if number == 5:
            print("writing", flush=True)

asyncio.run(main())
"""


def test_a_backup_beside_a_process_that_writes_is_one_moment(tmp_path: Path) -> None:
    data = tmp_path / "data"
    writer = subprocess.Popen(
        [sys.executable, "-c", WRITER, str(data)], stdout=subprocess.PIPE, text=True
    )
    assert writer.stdout is not None
    assert writer.stdout.readline() == "writing\n"
    numbers = []
    for turn in range(5):
        target = tmp_path / f"{turn}.sqlite3"
        back_up(data / FILE_NAME, target)
        with closing(sqlite3.connect(target)) as copy:
            (number,) = copy.execute("SELECT max(sequence) FROM job_events").fetchone()
            (result,) = copy.execute(
                "SELECT json_extract(result, '$.energy_wh') FROM jobs"
            ).fetchone()
        assert result == number, "state and event are one transaction"
        numbers.append(number)
    assert writer.poll() is None
    writer.kill()
    writer.stdout.close()
    writer.wait()
    assert numbers == sorted(numbers)
    assert numbers[0] < numbers[-1]


def test_a_backup_never_replaces_a_file(tmp_path: Path) -> None:
    file = healthy(tmp_path / "data")
    target = tmp_path / "precious"
    target.write_text("mine")
    with pytest.raises(BackupError, match="there already"):
        back_up(file, target)
    assert target.read_text() == "mine"
    assert [path.name for path in tmp_path.iterdir() if path.is_file()] == ["precious"]


def test_a_backup_that_fails_leaves_nothing(tmp_path: Path) -> None:
    file = healthy(tmp_path / "data")
    with pytest.raises(DiskError, match="No such file"):
        back_up(file, tmp_path / "no folder" / "backup")
    with pytest.raises(BackupError, match="no database"):
        back_up(tmp_path / "nothing", tmp_path / "backup")
    file.write_bytes(file.read_bytes()[:4096] + b"\x55" * 40_000)
    with pytest.raises(DatabaseBrokenError):
        back_up(file, tmp_path / "backup")
    assert [path for path in tmp_path.iterdir() if path.is_file()] == []


def test_a_copy_is_made_once_a_day_and_old_ones_go(tmp_path: Path) -> None:
    file = healthy(tmp_path)
    backups = Backups(tmp_path, 2)
    backups.make_due(file, before_upgrade=False)
    backups.make_due(file, before_upgrade=False)
    (made,) = backups.all()
    assert made.path.name.startswith(DAILY)
    first = Backup(made.path.rename(made.path.with_name(f"{DAILY}1.sqlite3")), made.made_at)
    old = first.path.with_name(f"{BEFORE_UPGRADE}2020.sqlite3")
    back_up(file, old)
    for days in (4, 3, 2):
        path = first.path.with_name(f"{DAILY}{days}.sqlite3")
        back_up(file, path)
        then = (datetime.now(UTC) - timedelta(days=days)).timestamp()
        os.utime(path, (then, then))
    for path in (first.path, old):
        then = (datetime.now(UTC) - timedelta(days=1, minutes=1)).timestamp()
        os.utime(path, (then, then))
    backups.make_due(file, before_upgrade=False)
    names = {backup.path.name for backup in backups.all()}
    assert len(names) == 3
    assert {first.path.name, old.name} < names
    Backups(tmp_path, 0).make_due(file, before_upgrade=False)
    assert {backup.path.name for backup in backups.all()} == names


def test_a_backup_comes_back_and_what_was_there_is_kept(tmp_path: Path) -> None:
    file = healthy(tmp_path)
    backup = tmp_path / "backup"
    back_up(file, backup)
    before = backup.read_bytes()
    file.write_bytes(b"shopping list\n" * 1000)
    aside = restore(backup, tmp_path)
    assert aside is not None
    assert aside.read_bytes() == b"shopping list\n" * 1000
    assert backup.read_bytes() == before

    async def scenario() -> None:
        database = await opened(tmp_path)
        assert database.problem is None
        restored = await JobStore(database).get(job(7).id)
        assert restored is not None
        assert restored.state is JobState.FAILED, "it is not taken up again"
        assert restored.error is not None
        assert restored.error.code == "restored"
        assert await JobStore(database).unfinished() == []
        await database.close()

    run_virtual(scenario())


def test_the_plug_is_where_it_is_and_not_where_it_was_at_the_backup(tmp_path: Path) -> None:
    async def now(record: PlugRecord) -> None:
        database = await opened(tmp_path)
        plug = StoredPlug(database, tmp_path)
        await plug.load()
        await plug.save(record)
        await database.close()

    async def found() -> PlugRecord | None:
        database = await opened(tmp_path)
        record = await StoredPlug(database, tmp_path).load()
        await database.close()
        return record

    inserted = PlugRecord(PlugState.INSERTED, None)
    run_virtual(now(PlugRecord(PlugState.PARKED, None)))
    backup = tmp_path / "backup"
    back_up(tmp_path / FILE_NAME, backup)
    run_virtual(now(inserted))
    restore(backup, tmp_path)
    assert run_virtual(found()) == inserted
    (tmp_path / PLUG_FILE).unlink()
    restore(backup, tmp_path)
    assert run_virtual(found()) == PlugRecord(PlugState.UNKNOWN, None)


def test_a_backup_of_the_first_release_comes_back(tmp_path: Path) -> None:
    backup = first_release(tmp_path / "old")
    with closing(sqlite3.connect(backup)) as connection:
        connection.execute("PRAGMA journal_mode = DELETE")
    before = rows(backup)
    assert restore(backup, tmp_path) is None
    assert rows(backup) == before

    async def scenario() -> None:
        database = await opened(tmp_path)
        jobs = JobStore(database)
        states = {found.id: found.state for found in await jobs.page(before=None, limit=9)}
        assert states[INTERRUPTED] is JobState.FAILED
        assert states[SUCCEEDED] is JobState.SUCCEEDED
        await database.close()

    run_virtual(scenario())


@pytest.mark.parametrize("what", ["nothing", "another file", "another database", "newer"])
def test_what_is_no_backup_is_refused_and_nothing_changes(tmp_path: Path, what: str) -> None:
    file = healthy(tmp_path)
    before = file.read_bytes()
    backup = tmp_path / "backup"
    kind: type[StorageError] = BackupError
    if what == "another file":
        backup.write_text("shopping list" * 100)
        kind = DatabaseBrokenError
    elif what == "another database":
        with closing(sqlite3.connect(backup)) as connection:
            connection.execute("CREATE TABLE recipes (id INTEGER)")
    elif what == "newer":
        back_up(file, backup)
        with closing(sqlite3.connect(backup)) as connection:
            connection.execute(f"PRAGMA user_version = {int(HEAD) + 1}")
        kind = DatabaseVersionError
    with pytest.raises(kind):
        restore(backup, tmp_path)
    assert file.read_bytes() == before
    assert list(tmp_path.glob("*restoring*")) == []


def test_a_new_beginning_keeps_the_old_file_and_doubts_the_plug(tmp_path: Path) -> None:
    file = healthy(tmp_path)
    before = file.read_bytes()
    aside = begin_anew(tmp_path)
    assert aside is not None
    assert aside.read_bytes() == before
    assert begin_anew(tmp_path) is None

    async def scenario() -> None:
        database = await opened(tmp_path)
        assert await JobStore(database).page(before=None, limit=9) == []
        record = await StoredPlug(database, tmp_path).load()
        assert record == PlugRecord(PlugState.UNKNOWN, None)
        await database.close()

    run_virtual(scenario())


def test_only_one_process_at_a_time_uses_a_folder(tmp_path: Path) -> None:
    program = (
        "import sys; from pathlib import Path\n"
        "from server.storage.folder_lock import holding\n"
        "with holding(Path(sys.argv[1])):\n"
        "    print('held', flush=True); sys.stdin.read()\n"
    )
    other = subprocess.Popen(
        [sys.executable, "-c", program, str(tmp_path)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert other.stdout is not None
    assert other.stdin is not None
    assert other.stdout.readline() == "held\n"
    with pytest.raises(FolderInUseError, match=str(tmp_path)), holding(tmp_path):
        pass
    other.kill()
    other.wait()
    other.stdout.close()
    other.stdin.close()
    with holding(tmp_path):
        pass
