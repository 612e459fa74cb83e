"""The usual home of the data: one SQLite file in the data folder."""

from __future__ import annotations

import logging
import os
import sqlite3
from contextlib import closing
from datetime import UTC, datetime
from pathlib import Path
from urllib.parse import quote

from sqlalchemy import Connection, Engine, text
from sqlalchemy.exc import DBAPIError

from server.storage.backups import Backups, copy_file
from server.storage.engines import file_engine
from server.storage.errors import (
    DatabaseBrokenError,
    DataFolderError,
    DiskError,
    ReadOnlyError,
    StorageError,
)
from server.storage.trouble import from_database, from_sqlite
from server.storage.upgrade import is_empty, needs_upgrade, upgrade

_log = logging.getLogger(__name__)

FILE_NAME = "plugpilot.sqlite3"


class SqliteHome:
    """One SQLite file. All methods block.

    Args:
        folder: Where the file lives; made if missing.
        backups_kept: How many daily copies.

    Raises:
        DataFolderError: the folder cannot be made.
    """

    def __init__(self, folder: Path, backups_kept: int) -> None:
        try:
            folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        except OSError as error:
            raise DataFolderError(
                f"{folder} cannot be made: {error.strerror}.", folder=str(folder)
            ) from error
        self.file = folder / FILE_NAME
        self.engine: Engine = file_engine(self.file)
        self._backups = Backups(folder, backups_kept)

    @property
    def name(self) -> str:
        """For sentences."""
        return str(self.file)

    @property
    def worked_before(self) -> bool:
        """There is a file that somebody has filled."""
        return self.file.is_file() and self.file.stat().st_size > 0

    def prepare(self) -> None:
        """Check the file, bring its schema up to date, and see that it can be written.

        Raises:
            DataFolderError: there is no file yet, and none can be made.
            DatabaseVersionError: a newer PlugPilot made the file.
            LostDatabaseError: the file is damaged, or cannot be written for now.
        """
        worked_before = self.worked_before
        try:
            self._prepare()
        except DBAPIError as error:
            trouble = from_database(error, self.name)
            if isinstance(trouble, DatabaseBrokenError):
                raise self._offering_backup(trouble) from error
            if not worked_before:
                raise DataFolderError(
                    f"{self.file} cannot be opened: {error.orig}.", file=self.name
                ) from error
            if isinstance(trouble, DiskError) and not os.access(self.file.parent, os.W_OK):
                trouble = ReadOnlyError(trouble.detail, **trouble.context)
            raise trouble from error
        except DatabaseBrokenError as error:
            raise self._offering_backup(error) from error

    def _prepare(self) -> None:
        # A database that was closed in order has no log beside it.
        closed_in_order = not self.file.with_name(f"{FILE_NAME}-wal").exists()
        with self.engine.connect() as connection:
            # Changing a table may mean to drop the old one, with references to it.
            _foreign_keys(connection, on=False)
            with connection.begin():
                self._check(connection, thoroughly=not closed_in_order)
                is_new = is_empty(connection)
                outdated = needs_upgrade(connection, self.name)
            if outdated and not is_new:
                self._backups.make_before_upgrade(self.file, datetime.now(UTC))
            elif not is_new:
                self._backups.make_due(self.file, datetime.now(UTC))
            with connection.begin():
                if outdated:
                    upgrade(connection)
                    _check_references(connection, self.name)
                # Writes at every start, so that a file that cannot be written is found now.
                number = connection.execute(text("PRAGMA user_version")).scalar_one()
                connection.execute(text(f"PRAGMA user_version = {number}"))
            _foreign_keys(connection, on=True)

    def _check(self, connection: Connection, *, thoroughly: bool) -> None:
        """Read the whole file; after a crash compare the indexes and references with it, too."""
        check = "integrity_check" if thoroughly else "quick_check"
        verdict = connection.execute(text(f"PRAGMA {check}(1)")).scalar()
        if verdict != "ok":
            raise DatabaseBrokenError(f"{self.name}: SQLite says: {verdict}.", file=self.name)
        if thoroughly:
            _check_references(connection, self.name)

    def back_up_if_due(self, now: datetime) -> None:
        """Make today's copy if there is none yet; what goes wrong is only written down."""
        self._backups.make_due(self.file, now)

    def copy_into(self, spare: Engine) -> None:
        """Fill an empty database in memory with what can be read.

        Raises:
            StorageError: nothing can be read.
        """
        target = spare.raw_connection()
        try:
            self._copy(target.driver_connection)
        except sqlite3.Error as error:
            raise from_sqlite(error, self.name) from error
        finally:
            target.close()

    def _copy(self, target: object) -> None:
        uri = f"file:{quote(str(self.file))}?mode=ro"
        try:
            with closing(sqlite3.connect(uri, uri=True)) as source:
                copy_file(source, target)
        except sqlite3.OperationalError as error:
            if not error.sqlite_errorname.startswith(("SQLITE_CANTOPEN", "SQLITE_READONLY")):
                raise
            # Where nothing at all may be written. It does not read the log, so it comes second.
            with closing(sqlite3.connect(f"{uri}&immutable=1", uri=True)) as source:
                copy_file(source, target)

    def _offering_backup(self, error: StorageError) -> StorageError:
        newest = self._backups.newest()
        if newest is None:
            return error
        return DatabaseBrokenError(
            f"{error.detail} The newest backup is {newest.path}, of {newest.made_at:%Y-%m-%d %H:%M}"
            " UTC.",
            **error.context,
            backup=str(newest.path),
        )


def _check_references(connection: Connection, name: str) -> None:
    lost = connection.execute(text("PRAGMA foreign_key_check")).first()
    if lost is not None:
        raise DatabaseBrokenError(f"{name}: a row of {lost[0]} belongs to nothing.", file=name)


def _foreign_keys(connection: Connection, *, on: bool) -> None:
    # Has no effect inside a transaction, and SQLAlchemy would begin one.
    raw = connection.connection.driver_connection
    assert isinstance(raw, sqlite3.Connection)  # noqa: S101 - the engine of this module
    raw.execute(f"PRAGMA foreign_keys = {'ON' if on else 'OFF'}")
