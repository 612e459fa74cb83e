"""Copies of the SQLite file, made while it is in use, and read again before they count."""

from __future__ import annotations

import contextlib
import logging
import os
import sqlite3
from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path
from urllib.parse import quote

from server.storage import engines
from server.storage.errors import BackupError, DatabaseBrokenError, StorageError
from server.storage.trouble import from_sqlite, from_system

_log = logging.getLogger(__name__)

FOLDER = "backups"
DAILY = "plugpilot-"
BEFORE_UPGRADE = "before-upgrade-"
BEFORE_RESTORE = "before-restore-"
ENDING = ".sqlite3"
UNFINISHED = ".part"
OWNER_ONLY = 0o600
EVERY = timedelta(days=1)


@dataclass(frozen=True, slots=True)
class Backup:
    """One copy.

    Attributes:
        path: The file.
        made_at: When it was made.
    """

    path: Path
    made_at: datetime


def back_up(source: Path, target: Path) -> None:
    """Copy a database, also one that is in use, and check the copy.

    The copy is one moment of the database: a transaction is in it as a whole or not at all.

    Args:
        source: An SQLite file.
        target: A file that does not exist yet.

    Raises:
        BackupError: there is something at the target, or no database at the source.
        StorageError: the source cannot be read, or the target not written. Nothing is left there.
    """
    if not source.is_file():
        raise BackupError(f"There is no database {source}.", file=str(source))

    def fill(part: Path) -> None:
        with (
            closing(sqlite3.connect(f"file:{quote(str(source))}?mode=rw", uri=True)) as data,
            closing(sqlite3.connect(part)) as copy,
        ):
            copy_file(data, copy)

    make_backup(target, fill)


def make_backup(target: Path, fill: Callable[[Path], None]) -> None:
    """Make a file that appears under its name only when it is whole and has been read again.

    Args:
        target: A file that does not exist yet.
        fill: Makes an SQLite database of the empty file that it is given.

    Raises:
        BackupError: there is something at the target.
        StorageError: it cannot be made. Nothing is left there.
    """
    part = target.with_name(target.name + UNFINISHED)
    with _reserved(target):
        try:
            part.unlink(missing_ok=True)
            os.close(os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL, OWNER_ONLY))
            fill(part)
            with closing(sqlite3.connect(part)) as copy:
                copy.execute("PRAGMA journal_mode = DELETE")  # one file, without a log beside it
            check_backup(part)
            put_in_place(part, target)
        except sqlite3.Error as error:
            raise from_sqlite(error, str(target)) from error
        except OSError as error:
            raise from_system(error, str(target)) from error
        finally:
            for ending in ("", "-wal", "-shm"):
                part.with_name(part.name + ending).unlink(missing_ok=True)


def copy_file(source: sqlite3.Connection, target: object) -> None:
    """Copy a whole database in one step, and check the copy.

    Raises:
        sqlite3.Error: the source cannot be read, or the target not written.
    """
    if not isinstance(target, sqlite3.Connection):
        raise TypeError("not a connection to SQLite")
    # A read transaction of our own: without it the module waits for ever while another program
    # holds the file.
    source.execute(f"PRAGMA busy_timeout = {engines.BUSY_MS}")
    source.execute("BEGIN")
    source.execute("SELECT 1 FROM sqlite_master").fetchone()
    source.backup(target, pages=-1)
    source.execute("ROLLBACK")
    verdict = target.execute("PRAGMA quick_check(1)").fetchone()[0]
    if verdict != "ok":
        error = sqlite3.DatabaseError(verdict)
        error.sqlite_errorname = "SQLITE_CORRUPT"
        raise error


def check_backup(file: Path) -> None:
    """Read a copy from end to end. Nothing may write it meanwhile.

    Raises:
        BackupError: it is no database of PlugPilot.
        StorageError: it is damaged, or cannot be read.
    """
    check_file(file, "mode=ro&immutable=1")


def check_file(file: Path, how: str = "mode=rw") -> None:
    """Read a database from end to end, also one that is in use.

    Args:
        file: Of the database.
        how: Parameters of SQLite's address of it.

    Raises:
        BackupError: it is no database of PlugPilot.
        StorageError: it is damaged, or cannot be read.
    """
    try:
        with closing(sqlite3.connect(f"file:{quote(str(file))}?{how}", uri=True)) as connection:
            verdict = connection.execute("PRAGMA integrity_check(1)").fetchone()[0]
            lost = connection.execute("PRAGMA foreign_key_check").fetchone()
            jobs = connection.execute("SELECT 1 FROM sqlite_master WHERE name = 'jobs'").fetchone()
    except sqlite3.Error as error:
        raise from_sqlite(error, str(file)) from error
    if verdict != "ok" or lost is not None:
        said = verdict if verdict != "ok" else f"a row of {lost[0]} belongs to nothing"
        raise DatabaseBrokenError(f"{file}: SQLite says: {said}.", file=str(file))
    if jobs is None:
        raise BackupError(f"{file} is no database of PlugPilot.", file=str(file))


def put_in_place(part: Path, target: Path) -> None:
    """Let a finished file take its name, and keep both through a power cut."""
    _flush(part, os.O_RDWR)
    part.replace(target)
    if os.name == "posix":  # elsewhere a folder cannot be opened, and need not be
        _flush(target.parent, os.O_RDONLY)


def _flush(path: Path, flags: int) -> None:
    descriptor = os.open(path, flags)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


class Backups:
    """The copies that PlugPilot makes by itself, in a folder beside the database.

    Args:
        folder: The data folder.
        kept: How many daily ones; 0 makes none.
    """

    def __init__(self, folder: Path, kept: int) -> None:
        self._folder = folder / FOLDER
        self._kept = kept

    def all(self) -> list[Backup]:
        """Newest first."""
        found = [
            Backup(path, datetime.fromtimestamp(path.stat().st_mtime, UTC))
            for path in self._folder.glob(f"*{ENDING}")
            if path.stat().st_size > 0
        ]
        return sorted(found, key=lambda backup: backup.made_at, reverse=True)

    def newest(self) -> Backup | None:
        """The newest one, if there is any that can be read."""
        try:
            return next(iter(self.all()), None)
        except OSError:
            return None

    def make_before_upgrade(self, file: Path, now: datetime) -> None:
        """Copy a database whose schema is about to change.

        Raises:
            StorageError: it cannot be made.
        """
        self._make(file, BEFORE_UPGRADE, now)

    def make_due(self, file: Path, now: datetime) -> None:
        """Copy a database, which may be in use, if the newest copy is a day old.

        What goes wrong is only written down: the robot does not depend on it.
        """
        newest = self.newest()
        if self._kept == 0 or (newest and now - newest.made_at < EVERY):
            return
        try:
            self._make(file, DAILY, now)
            self._tidy()
        except StorageError as error:
            _log.warning("no backup could be made: %s", error.detail)
        except OSError as error:
            _log.warning("old backups could not be removed: %s", error)

    def _make(self, file: Path, kind: str, now: datetime) -> None:
        try:
            self._folder.mkdir(mode=0o700, exist_ok=True)
        except OSError as error:
            raise from_system(error, str(self._folder)) from error
        target = self._folder / f"{kind}{stamp(now)}{ENDING}"
        back_up(file, target)
        os.utime(target, (now.timestamp(), now.timestamp()))
        _log.info("made the backup %s", target)

    def _tidy(self) -> None:
        daily = [backup.path for backup in self.all() if backup.path.name.startswith(DAILY)]
        for path in daily[self._kept :]:
            path.unlink(missing_ok=True)


def stamp(now: datetime | None = None) -> str:
    """A date in UTC, by default now, as part of a file's name."""
    return f"{now or datetime.now(UTC):%Y-%m-%dT%H%M%S}"


@contextlib.contextmanager
def _reserved(target: Path) -> Iterator[None]:
    """Own a name that nobody else has; give it back if nothing comes of it."""
    try:
        os.close(os.open(target, os.O_WRONLY | os.O_CREAT | os.O_EXCL, OWNER_ONLY))
    except FileExistsError as error:
        raise BackupError(
            f"{target} is there already, and backups never replace a file.", file=str(target)
        ) from error
    except OSError as error:
        raise from_system(error, str(target)) from error
    try:
        yield
    except BaseException:
        target.unlink(missing_ok=True)
        raise
