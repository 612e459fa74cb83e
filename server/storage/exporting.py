"""A backup of a PostgreSQL server: the same kind of SQLite file as every other backup."""

from __future__ import annotations

from pathlib import Path

from sqlalchemy.exc import DBAPIError

from server.storage.backups import make_backup
from server.storage.copying import copy_tables
from server.storage.engines import file_engine
from server.storage.postgres_home import PostgresHome
from server.storage.trouble import from_database
from server.storage.upgrade import upgrade


def export(home: PostgresHome, target: Path) -> None:
    """Copy what is on a server into a file, as it is at one moment.

    Args:
        home: The server; its schema has to be this version's.
        target: A file that does not exist yet.

    Raises:
        BackupError: there is something at the target.
        StorageError: the server cannot be read, or the target not written.
    """

    def fill(part: Path) -> None:
        engine = file_engine(part)
        snapshot = home.engine.execution_options(isolation_level="REPEATABLE READ")
        try:
            with snapshot.connect() as source, engine.begin() as copy:
                upgrade(copy)
                copy_tables(source, copy)
        except DBAPIError as error:
            raise from_database(error, home.name) from error
        finally:
            engine.dispose()

    make_backup(target, fill)
