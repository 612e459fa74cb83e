"""What a database says when it refuses, as one of our errors."""

from __future__ import annotations

import errno
import sqlite3
from collections.abc import Mapping

from sqlalchemy.exc import DBAPIError

from server.storage.errors import (
    DatabaseBrokenError,
    DatabaseBusyError,
    DatabaseUnreachableError,
    DiskError,
    DiskFullError,
    ReadOnlyError,
    StorageError,
)

_SQLITE: Mapping[str, type[StorageError]] = {
    "SQLITE_FULL": DiskFullError,
    "SQLITE_READONLY": ReadOnlyError,
    "SQLITE_PERM": ReadOnlyError,
    "SQLITE_CANTOPEN": DiskError,
    "SQLITE_IOERR": DiskError,
    "SQLITE_BUSY": DatabaseBusyError,
    "SQLITE_CORRUPT": DatabaseBrokenError,
    "SQLITE_NOTADB": DatabaseBrokenError,
}
"""By the beginning of the name of SQLite's extended result code."""

_POSTGRES: Mapping[str, type[StorageError]] = {
    "08": DatabaseUnreachableError,
    "25006": ReadOnlyError,
    "53100": DiskFullError,
    "53": DatabaseUnreachableError,  # out of memory or of connections
    "55P03": DatabaseBusyError,
    "57014": DatabaseBusyError,  # it took longer than statement_timeout
    "57P": DatabaseUnreachableError,
    "58": DiskError,
    "XX001": DatabaseBrokenError,
    "XX002": DatabaseBrokenError,
}
"""By the beginning of the SQLSTATE; longer ones win."""

_SYSTEM: Mapping[int, type[StorageError]] = {
    errno.ENOSPC: DiskFullError,
    errno.EDQUOT: DiskFullError,
    errno.EROFS: ReadOnlyError,
    errno.EACCES: ReadOnlyError,
    errno.EPERM: ReadOnlyError,
}


def from_database(error: DBAPIError, place: str) -> StorageError:
    """The error that tells a person what the database has said.

    Args:
        error: As SQLAlchemy raises it.
        place: File or server.
    """
    original = error.orig
    if isinstance(original, sqlite3.Error):
        return from_sqlite(original, place)
    said = " ".join(str(original).split())
    state = getattr(original, "sqlstate", None)
    if state is None:  # psycopg itself: it has no connection, or lost it
        kind: type[StorageError] = (
            DatabaseUnreachableError if _has_no_connection(error) else StorageError
        )
    else:
        known = [code for code in _POSTGRES if state.startswith(code)]
        kind = _POSTGRES[max(known, key=len)] if known else StorageError
    return kind(f"PostgreSQL says: {said}", place=place)


def from_sqlite(error: sqlite3.Error, place: str) -> StorageError:
    """The same for what the sqlite3 module raises."""
    name = getattr(error, "sqlite_errorname", None) or ""
    kind = next((k for prefix, k in _SQLITE.items() if name.startswith(prefix)), StorageError)
    if kind is DatabaseBrokenError:
        return kind(f"{place} is not a readable SQLite database: {error}.", file=place)
    return kind(f"{place}: SQLite says: {error}.", file=place)


def from_system(error: OSError, place: str) -> StorageError:
    """The same for what the operating system refuses."""
    kind = _SYSTEM.get(error.errno or 0, DiskError)
    return kind(f"{place}: {error.strerror}.", file=place)


def _has_no_connection(error: DBAPIError) -> bool:
    return error.connection_invalidated or type(error.orig).__name__ in {
        "OperationalError",
        "ConnectionTimeout",
        "InterfaceError",
    }
