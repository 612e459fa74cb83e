"""The SQLite database: opened, checked, and used from one worker thread."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, TypeVar

from sqlalchemy import Connection, Engine, create_engine, event, text
from sqlalchemy.exc import DBAPIError, SQLAlchemyError
from sqlalchemy.orm import Session
from sqlalchemy.pool import StaticPool

from server.storage import access_tables  # noqa: F401 - makes its tables known to Base
from server.storage.errors import (
    DatabaseBrokenError,
    DatabaseVersionError,
    DataFolderError,
    StorageError,
)
from server.storage.tables import Base

T = TypeVar("T")

FILE_NAME = "plugpilot.sqlite3"

SCHEMA_VERSION = 1
"""Kept in the file (PRAGMA user_version). Raise it with every change of the tables."""


class Database:
    """Runs pieces of work, each in one transaction, off the event loop and in order.

    A transaction that has returned is on disk (WAL with synchronous=FULL). One whose caller is
    cancelled runs to its end all the same.

    Args:
        folder: Where the file lives; made if missing. None keeps everything in memory.

    Raises:
        DataFolderError: the folder cannot be made.
    """

    def __init__(self, folder: Path | None) -> None:
        self._engine = _engine(folder)
        # One worker: SQLite has one writer anyway, and the order of the journal stays the order
        # of the calls.
        self._worker = ThreadPoolExecutor(max_workers=1, thread_name_prefix="database")

    async def open(self) -> None:
        """Check the file and make what is missing.

        Raises:
            DataFolderError: the folder or file cannot be written.
            DatabaseBrokenError: the file is damaged.
            DatabaseVersionError: another version of PlugPilot made the file.
        """
        await self._in_worker(self._prepare)

    async def run(self, work: Callable[[Session], T]) -> T:
        """Run ``work`` in a transaction and return its result.

        Raises:
            StorageError: the database refused; nothing of the work was kept.
        """
        return await self._in_worker(lambda: self._transact(work))

    async def close(self) -> None:
        """Finish what was begun and close the file."""
        await self._in_worker(self._engine.dispose)
        self._worker.shutdown(wait=False)

    async def _in_worker(self, call: Callable[[], T]) -> T:
        return await asyncio.get_running_loop().run_in_executor(self._worker, call)

    def _prepare(self) -> None:
        try:
            with self._engine.begin() as connection:
                verdict = connection.execute(text("PRAGMA quick_check")).scalar()
                if verdict != "ok":
                    raise DatabaseBrokenError(f"SQLite says: {verdict}.", file=self._file)
                self._refuse_other_version(connection)
                Base.metadata.create_all(connection)
                # Writes at every start, so that a file that cannot be written is found now.
                connection.execute(text(f"PRAGMA user_version = {SCHEMA_VERSION}"))
        except DBAPIError as error:
            if "not a database" in str(error.orig) or "malformed" in str(error.orig):
                raise DatabaseBrokenError(
                    f"{self._file} is not a readable SQLite database.", file=self._file
                ) from error
            raise DataFolderError(
                f"{self._file} cannot be opened: {error.orig}.", file=self._file
            ) from error

    def _refuse_other_version(self, connection: Connection) -> None:
        version = connection.execute(text("PRAGMA user_version")).scalar_one()
        if version not in {0, SCHEMA_VERSION}:
            raise DatabaseVersionError(
                f"{self._file} has version {version}; this PlugPilot reads version "
                f"{SCHEMA_VERSION}.",
                file=self._file,
                version=version,
            )

    def _transact(self, work: Callable[[Session], T]) -> T:
        try:
            with Session(self._engine, expire_on_commit=False) as session, session.begin():
                return work(session)
        except DBAPIError as error:
            raise StorageError(f"SQLite says: {error.orig}.", file=self._file) from error
        except SQLAlchemyError as error:
            raise StorageError(f"The database refused: {error}", file=self._file) from error

    @property
    def _file(self) -> str:
        return self._engine.url.database or "the database in memory"


def _engine(folder: Path | None) -> Engine:
    if folder is None:
        engine = create_engine(
            "sqlite://", poolclass=StaticPool, connect_args={"check_same_thread": False}
        )
    else:
        try:
            folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        except OSError as error:
            raise DataFolderError(
                f"{folder} cannot be made: {error.strerror}.", folder=str(folder)
            ) from error
        engine = create_engine(f"sqlite:///{folder / FILE_NAME}")
    event.listen(engine, "connect", _set_pragmas)
    return engine


def _set_pragmas(connection: Any, _record: object) -> None:  # noqa: ANN401 - a DBAPI connection
    cursor = connection.cursor()
    cursor.execute("PRAGMA journal_mode = WAL")
    cursor.execute("PRAGMA synchronous = FULL")
    cursor.execute("PRAGMA foreign_keys = ON")
    cursor.execute("PRAGMA busy_timeout = 3000")
    cursor.close()
