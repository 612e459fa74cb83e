"""Memory in place of a database that cannot be written for now, and what it owes to that one."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable
from typing import Any

from sqlalchemy.orm import Session

from server.storage.engines import memory_engine
from server.storage.errors import LostDatabaseError, StorageError
from server.storage.home import Home
from server.storage.models import Base
from server.storage.upgrade import needs_upgrade, upgrade

Work = Callable[[Session], Any]

IS_SPARE = "is_spare"
"""Key in the info of a session."""

MOST_OWED = 20_000
"""Pieces of work that are kept at most; each is some hundred bytes."""


class Spare:
    """A copy of the database in memory.

    Args:
        home: What it stands in for; copied as far as it can be read.
        trouble: Why it is needed.
    """

    def __init__(self, home: Home, trouble: LostDatabaseError) -> None:
        self.trouble = trouble
        self.engine = memory_engine()
        self.owed: list[Work] = []
        self.is_copy = True
        try:
            home.copy_into(self.engine)
            with self.engine.begin() as connection:
                if needs_upgrade(connection, home.name):
                    upgrade(connection)
        except StorageError:
            self.is_copy = False
            self.engine.dispose()
            self.engine = memory_engine()
            with self.engine.begin() as connection:
                Base.metadata.create_all(connection)

    def changes(self) -> int:
        """How many rows were ever changed."""
        connection = self.engine.raw_connection()
        try:
            raw = connection.driver_connection
            assert isinstance(raw, sqlite3.Connection)  # noqa: S101 - the engine made above
            return raw.total_changes
        finally:
            connection.close()

    def owe(self, work: Work) -> None:
        """Remember to do a piece of work at home, too.

        Raises:
            LostDatabaseError: too much is owed already.
        """
        if len(self.owed) >= MOST_OWED:
            raise self.trouble
        self.owed.append(work)


def is_spare(session: Session) -> bool:
    """The session works on memory: what it writes is lost with the process."""
    return bool(session.info.get(IS_SPARE))
