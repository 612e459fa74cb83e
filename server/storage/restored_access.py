"""Who may do what after a backup was restored: who may now, not who might then.

A phone that was removed, a key that was revoked, a technician who has left: none of them may come
back with an old copy of the database. The audit trail goes on, too: an old copy must not take away
what was written since.
"""

from __future__ import annotations

import logging
import sqlite3
import tempfile
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import quote

from sqlalchemy import Connection, Table, delete, func, insert, select
from sqlalchemy.exc import DBAPIError

from server.storage.access_tables import (
    ApiKeyRow,
    AuditRow,
    DeviceRow,
    InvitationRow,
    PasskeyRow,
    PersonRow,
)
from server.storage.backups import copy_file
from server.storage.engines import file_engine
from server.storage.errors import StorageError
from server.storage.push_tables import PushKeyRow, PushSubscriptionRow
from server.storage.tables import Base
from server.storage.upgrade import needs_upgrade, upgrade

_log = logging.getLogger(__name__)

_KNOWN: tuple[type[Base], ...] = (
    PersonRow,
    DeviceRow,
    InvitationRow,
    ApiKeyRow,
    PasskeyRow,
    PushKeyRow,
    PushSubscriptionRow,
)
"""Referenced tables first. A device is told what happens as long as it may know."""


@dataclass(frozen=True, slots=True)
class AccessRows:
    """Who may do what in a database, and its audit trail.

    Attributes:
        known: Rows of people and of whatever lets somebody in, by table.
        trail: Rows of the audit trail, oldest first.
    """

    known: dict[str, list[dict[str, Any]]]
    trail: list[dict[str, Any]]


NOBODY = AccessRows({}, [])


def read_access(connection: Connection) -> AccessRows:
    """Read a database that has the schema of this version."""
    trail = select(_table(AuditRow)).order_by(AuditRow.sequence)
    return AccessRows(
        {row.__tablename__: _rows(connection, select(_table(row))) for row in _KNOWN},
        _rows(connection, trail),
    )


def access_in_file(file: Path) -> AccessRows:
    """Read the database of an installation that does not run; nobody if it cannot be read."""
    if not file.exists():
        return NOBODY
    try:
        with tempfile.TemporaryDirectory() as scratch:
            return _read_copy(file, Path(scratch) / file.name)
    except (sqlite3.Error, DBAPIError, StorageError) as error:
        _log.warning("who may do what could not be read from %s: %s", file, error)
        return NOBODY


def put_access(connection: Connection, rows: AccessRows) -> None:
    """Let a restored database know whom these rows know, and go on with their audit trail."""
    for row in reversed(_KNOWN):
        connection.execute(delete(row))
    for row in _KNOWN:
        if rows.known.get(row.__tablename__):
            connection.execute(insert(row), rows.known[row.__tablename__])
    missing = _missing_entries(connection, rows.trail)
    if missing:
        connection.execute(insert(AuditRow), missing)


def _missing_entries(connection: Connection, trail: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """What was added since the backup; nothing if that is of another installation."""
    newest = connection.scalar(select(func.max(AuditRow.sequence)))
    if newest is None:
        return trail
    link = connection.scalar(select(AuditRow.chain).where(AuditRow.sequence == newest))
    if not any(entry["sequence"] == newest and entry["chain"] == link for entry in trail):
        return []
    return [entry for entry in trail if entry["sequence"] > newest]


def _read_copy(file: Path, copy: Path) -> AccessRows:
    uri = f"file:{quote(str(file))}?mode=rw"
    with (
        closing(sqlite3.connect(uri, uri=True)) as source,
        closing(sqlite3.connect(copy)) as target,
    ):
        copy_file(source, target)
    engine = file_engine(copy)
    try:
        with engine.begin() as connection:
            if needs_upgrade(connection, str(file)):
                upgrade(connection)
            return read_access(connection)
    finally:
        engine.dispose()


def _table(row: type[Base]) -> Table:
    table = row.__table__
    assert isinstance(table, Table)  # noqa: S101 - no mapped class here selects from anything else
    return table


def _rows(connection: Connection, query: Any) -> list[dict[str, Any]]:  # noqa: ANN401 - of any table
    return [dict(row) for row in connection.execute(query).mappings()]
