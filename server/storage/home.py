"""Where the data lives when all is well."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path
from typing import Protocol

from sqlalchemy import Engine

from server.storage.engines import memory_engine
from server.storage.models import Base
from server.storage.postgres_home import PostgresHome
from server.storage.sqlite_home import SqliteHome


class Home(Protocol):
    """A database, and how it is made ready. All methods block."""

    @property
    def engine(self) -> Engine:
        """Where transactions go."""
        ...

    @property
    def name(self) -> str:
        """For sentences."""
        ...

    @property
    def worked_before(self) -> bool:
        """This is no new installation, so the robot has to start even if nothing can be kept."""
        ...

    def prepare(self) -> None:
        """Check it, bring its schema up to date, and see that it can be written.

        Raises:
            LostDatabaseError: for now it cannot be used.
            StorageError: it cannot be used at all.
        """
        ...

    def back_up_if_due(self, now: datetime) -> None:
        """Make today's copy if there is none yet, also while the database is in use."""
        ...

    def copy_into(self, spare: Engine) -> None:
        """Fill an empty database in memory with what can be read.

        Raises:
            StorageError: nothing can be read.
        """
        ...


class MemoryHome:
    """Keeps everything as long as the process: for simulations."""

    name = "the database in memory"
    worked_before = False

    def __init__(self) -> None:
        self.engine = memory_engine()

    def prepare(self) -> None:
        """Make the tables, all at once."""
        with self.engine.begin() as connection:
            Base.metadata.create_all(connection)

    def back_up_if_due(self, now: datetime) -> None:
        """What is in memory shall not survive."""

    def copy_into(self, spare: Engine) -> None:
        """There is nothing that could be lost."""


def home_of(folder: Path | None, url: str | None, backups_kept: int) -> Home:
    """The home that the settings name.

    Args:
        folder: The data folder; None keeps everything in memory.
        url: Of a PostgreSQL server, in place of the file in the folder.
        backups_kept: How many daily copies of the file.

    Raises:
        StorageError: it cannot be used.
    """
    if folder is None:
        return MemoryHome()
    if url is not None:
        return PostgresHome(url)
    return SqliteHome(folder, backups_kept)
