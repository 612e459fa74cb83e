"""A PostgreSQL server as the home of the data."""

from __future__ import annotations

from datetime import datetime

from sqlalchemy import Engine, text
from sqlalchemy.exc import DBAPIError

from server.storage.copying import copy_tables
from server.storage.engines import postgres_engine
from server.storage.trouble import from_database
from server.storage.upgrade import needs_upgrade, upgrade

UPGRADE_LOCK = 0x506C7567
"""Number of the lock that lets only one PlugPilot at a time change the schema."""


class PostgresHome:
    """A database on a server. All methods block.

    Args:
        url: Its address.

    Raises:
        MissingDriverError: psycopg is not installed.
    """

    worked_before = True
    """A server that is down now may have worked before, and the robot cannot wait for it."""

    def __init__(self, url: str) -> None:
        self.engine: Engine = postgres_engine(url)

    @property
    def name(self) -> str:
        """For sentences; without the password."""
        return self.engine.url.render_as_string(hide_password=True)

    def prepare(self) -> None:
        """Bring the schema up to date: all of it or nothing.

        Raises:
            DatabaseVersionError: a newer PlugPilot made it.
            StorageError: the server does not answer, or refuses.
        """
        try:
            with self.engine.begin() as connection:
                connection.execute(text("SELECT pg_advisory_xact_lock(:n)"), {"n": UPGRADE_LOCK})
                if needs_upgrade(connection, self.name):
                    upgrade(connection)
        except DBAPIError as error:
            raise from_database(error, self.name) from error

    def back_up_if_due(self, now: datetime) -> None:
        """Whoever runs the server makes its backups."""

    def copy_into(self, spare: Engine) -> None:
        """Fill an empty database in memory with what can be read.

        Raises:
            StorageError: nothing can be read.
        """
        try:
            snapshot = self.engine.execution_options(isolation_level="REPEATABLE READ")
            with snapshot.connect() as source, spare.begin() as target:
                upgrade(target)
                copy_tables(source, target)
        except DBAPIError as error:
            raise from_database(error, self.name) from error
