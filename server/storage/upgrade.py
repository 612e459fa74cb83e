"""Brings a database to the schema of this version, step by step, with Alembic."""

from __future__ import annotations

import logging
from pathlib import Path

from sqlalchemy import Connection, inspect, text

from server.storage.errors import DatabaseVersionError

_log = logging.getLogger(__name__)

MIGRATIONS = Path(__file__).parent / "migrations"

HEAD = "0006"
"""The newest step in migrations/versions. It stands here, too, so that a database that is up to
date needs no Alembic, whose import takes a Raspberry Pi a second."""


def is_empty(connection: Connection) -> bool:
    """There is no table yet."""
    return not inspect(connection).get_table_names()


def needs_upgrade(connection: Connection, name: str) -> bool:
    """Whether the schema is older than this version's.

    Args:
        connection: To the database.
        name: Of it, for the sentence of an error.

    Raises:
        DatabaseVersionError: it is newer.
    """
    sqlite = connection.dialect.name == "sqlite"
    if sqlite:  # versions before the first step kept their number only here
        number = connection.execute(text("PRAGMA user_version")).scalar_one()
        if number > int(HEAD):
            raise _too_new(name, number)
    if not inspect(connection).has_table("alembic_version"):
        return True
    revision = connection.execute(text("SELECT version_num FROM alembic_version")).scalar()
    if revision is not None and int(revision) > int(HEAD):
        raise _too_new(name, int(revision))
    return bool(revision != HEAD)


def upgrade(connection: Connection) -> None:
    """Carry out the steps that are missing, in the transaction of the connection.

    A database of the first release, which knew no steps, takes the first one without change.
    """
    logging.getLogger("alembic").setLevel(logging.WARNING)  # it names every plugin and step
    # imported late: see HEAD
    from alembic import command  # noqa: PLC0415
    from alembic.config import Config  # noqa: PLC0415

    config = Config()
    config.set_main_option("script_location", str(MIGRATIONS).replace("%", "%%"))
    config.attributes["connection"] = connection
    command.upgrade(config, "head")
    if connection.dialect.name == "sqlite":
        # the first release looks only at this number, and must not write into a newer schema
        connection.execute(text(f"PRAGMA user_version = {int(HEAD)}"))
    _log.info("the database has schema %s", HEAD)


def _too_new(name: str, version: int) -> DatabaseVersionError:
    return DatabaseVersionError(
        f"{name} has version {version}; this PlugPilot reads version {int(HEAD)}.",
        file=name,
        version=version,
    )
