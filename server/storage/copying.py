"""Copies the rows of all tables from one database to another, whatever their kinds."""

from __future__ import annotations

from sqlalchemy import Connection, select, text

from server.storage.models import Base

ROWS_AT_ONCE = 500


def copy_tables(source: Connection, target: Connection) -> None:
    """Copy every row; both have the schema of this version, and the target is empty.

    Referenced tables go first. On a server the source's transaction should be one that sees one
    moment only (``REPEATABLE READ``).
    """
    for table in Base.metadata.sorted_tables:
        rows = source.execution_options(yield_per=ROWS_AT_ONCE).execute(select(table))
        for part in rows.mappings().partitions():
            target.execute(table.insert(), [dict(row) for row in part])


def empty_tables(server: Connection) -> None:
    """Delete every row on a PostgreSQL server.

    By TRUNCATE, because the audit trail refuses to be deleted row by row.
    """
    names = ", ".join(table.name for table in Base.metadata.sorted_tables)
    server.execute(text(f"TRUNCATE {names}"))
