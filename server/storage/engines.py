"""Makes SQLAlchemy's engines: an SQLite file, memory, a PostgreSQL server."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from sqlalchemy import Connection, Engine, create_engine, event, make_url
from sqlalchemy.pool import StaticPool

from server.storage.errors import MissingDriverError

BUSY_MS = 3000
"""How long another program is waited for."""

_POSTGRES_CONNECTION = {
    "application_name": "plugpilot",
    "connect_timeout": 5,
    # A server that has vanished is noticed within seconds: the robot waits for its journal.
    "tcp_user_timeout": 5000,
    "keepalives_idle": 5,
    "keepalives_interval": 2,
    "keepalives_count": 3,
    "options": f"-c statement_timeout=10000 -c lock_timeout={BUSY_MS} -c timezone=UTC",
}


def file_engine(path: Path) -> Engine:
    """For an SQLite file. A transaction that has returned is on disk (WAL, synchronous=FULL)."""
    return _sqlite(create_engine(f"sqlite:///{path}"))


def memory_engine() -> Engine:
    """For an SQLite database that lives as long as the engine."""
    return _sqlite(
        create_engine("sqlite://", poolclass=StaticPool, connect_args={"check_same_thread": False})
    )


def postgres_engine(url: str) -> Engine:
    """For a PostgreSQL server, through psycopg 3.

    Raises:
        MissingDriverError: psycopg is not installed.
    """
    address = make_url(url).set(drivername="postgresql+psycopg")
    try:
        return create_engine(address, pool_pre_ping=True, connect_args=dict(_POSTGRES_CONNECTION))
    except ImportError as error:
        raise MissingDriverError(f"PostgreSQL needs psycopg: {error}.") from error


def _sqlite(engine: Engine) -> Engine:
    event.listen(engine, "connect", _set_up)
    event.listen(engine, "begin", _begin)
    return engine


def _set_up(connection: Any, _record: object) -> None:  # noqa: ANN401 - a DBAPI connection
    # The module's own transactions would leave changes of tables outside.
    connection.isolation_level = None
    cursor = connection.cursor()
    cursor.execute(f"PRAGMA busy_timeout = {BUSY_MS}")
    cursor.execute("PRAGMA journal_mode = WAL")
    cursor.execute("PRAGMA synchronous = FULL")
    cursor.execute("PRAGMA foreign_keys = ON")
    cursor.close()


def _begin(connection: Connection) -> None:
    # At once for writing: a transaction that began with reading could be refused half-way.
    connection.exec_driver_sql("BEGIN IMMEDIATE")
