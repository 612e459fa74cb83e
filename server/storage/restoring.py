"""Puts a backup in the place of the database, or nothing; what was there is kept aside.

Only for an installation that does not run: the caller holds the data folder.
"""

from __future__ import annotations

import sqlite3
import tempfile
from contextlib import closing
from datetime import UTC, datetime
from pathlib import Path
from urllib.parse import quote

from sqlalchemy import Connection, delete, func, select
from sqlalchemy.exc import DBAPIError
from sqlalchemy.orm import Session

from server.control.model import PlugState
from server.jobs.model import JobState
from server.schema.problem import problem_from
from server.storage.access_tables import InvitationRow
from server.storage.backups import check_backup, copy_file, put_in_place, stamp
from server.storage.copying import copy_tables, empty_tables
from server.storage.engines import file_engine
from server.storage.errors import BackupError
from server.storage.plug import UNKNOWN
from server.storage.plug_file import DamagedPlugFileError, NumberedRecord, PlugFile
from server.storage.postgres_home import PostgresHome
from server.storage.restored_access import access_in_file, put_access, read_access
from server.storage.sqlite_home import FILE_NAME
from server.storage.tables import JobEventRow, JobRow, PlugRow
from server.storage.trouble import from_database, from_sqlite, from_system
from server.storage.upgrade import needs_upgrade, upgrade

SET_ASIDE = "plugpilot-set-aside-"
PART = ".restoring"
BESIDE = ("", "-wal", "-shm")
"""The file and what SQLite keeps beside it; they belong together."""


class RestoredError(BackupError):
    """The backup was made in the middle of a job."""

    code = "restored"
    title = "A backup was restored"
    remedy = "Look where the plug is. If it is in the car, start an unplugging job."


def restore(backup: Path, folder: Path, *, with_people: bool = False) -> Path | None:
    """Put a backup in the place of the SQLite file of an installation.

    Where the plug is does not come from the backup: the installation's own record stays in force,
    and without one it is unknown. Jobs that had not ended are closed. Nor does it say who may do
    what: people, devices and keys stay as they are, and where they cannot be read nobody is known.

    Args:
        backup: It stays as it is; one of an earlier version is brought up to date on its way.
        folder: The data folder, held by the caller.
        with_people: Take people, devices and keys from the backup all the same, also those that
            were removed since.

    Returns:
        Where the file is now that was there before; None if there was none.

    Raises:
        BackupError: it is no backup of PlugPilot.
        DatabaseVersionError: a newer version made it.
        StorageError: it is damaged, or cannot be put in its place.
    """
    file = folder / FILE_NAME
    part = file.with_name(FILE_NAME + PART)
    try:
        _copy_up_to_date(backup, part)
        if not with_people:
            _know_whom_the_installation_knows(part, file)
        aside = set_aside(folder)
        put_in_place(part, file)
    except OSError as error:
        raise from_system(error, str(file)) from error
    finally:
        for ending in BESIDE:
            part.with_name(part.name + ending).unlink(missing_ok=True)
    return aside


def restore_to_server(backup: Path, home: PostgresHome, *, with_people: bool = False) -> None:
    """Replace the rows on a PostgreSQL server by those of a backup, all of them or none.

    Args:
        backup: As in ``restore``.
        home: The server.
        with_people: As in ``restore``.

    Raises:
        BackupError, DatabaseVersionError, StorageError: as in ``restore``.
    """
    with tempfile.TemporaryDirectory() as scratch:
        part = Path(scratch) / FILE_NAME
        _copy_up_to_date(backup, part)
        engine = file_engine(part)
        try:
            home.prepare()
            with engine.begin() as source, home.engine.begin() as target:
                if not with_people:
                    put_access(source, read_access(target))
                empty_tables(target)
                copy_tables(source, target)
        except DBAPIError as error:
            raise from_database(error, home.name) from error
        finally:
            engine.dispose()


def begin_anew(folder: Path) -> Path | None:
    """Set the SQLite file aside; the next start makes a new one. Returns where it is now.

    Raises:
        StorageError: the folder cannot be written.
    """
    plug = PlugFile(folder)
    try:
        if _is_lost(plug):
            # Else the new database would say that nothing was ever plugged in.
            plug.write(NumberedRecord(UNKNOWN, 1))
        return set_aside(folder)
    except OSError as error:
        raise from_system(error, str(folder)) from error


def set_aside(folder: Path) -> Path | None:
    """Give the SQLite file another name; nothing is ever deleted.

    Raises:
        OSError: the folder cannot be written.
    """
    file = folder / FILE_NAME
    if not file.exists():
        return None
    aside = folder / f"{SET_ASIDE}{stamp()}.sqlite3"
    for ending in reversed(BESIDE):
        part = file.with_name(FILE_NAME + ending)
        if part.exists():
            part.rename(aside.with_name(aside.name + ending))
    return aside


def _is_lost(plug: PlugFile) -> bool:
    try:
        return plug.read() is None
    except DamagedPlugFileError:
        plug.path.unlink()
        return True


def _copy_up_to_date(backup: Path, part: Path) -> None:
    if not backup.is_file():
        raise BackupError(f"There is no file {backup}.", file=str(backup))
    check_backup(backup)
    try:
        uri = f"file:{quote(str(backup))}?mode=ro&immutable=1"
        part.unlink(missing_ok=True)
        with (
            closing(sqlite3.connect(uri, uri=True)) as source,
            closing(sqlite3.connect(part)) as copy,
        ):
            copy_file(source, copy)
    except sqlite3.Error as error:
        raise from_sqlite(error, str(backup)) from error
    engine = file_engine(part)
    try:
        with engine.begin() as connection:
            if needs_upgrade(connection, str(backup)):
                upgrade(connection)
            _forget_the_moment(connection)
    except DBAPIError as error:
        raise from_database(error, str(backup)) from error
    finally:
        engine.dispose()


def _know_whom_the_installation_knows(part: Path, file: Path) -> None:
    engine = file_engine(part)
    try:
        with engine.begin() as connection:
            put_access(connection, access_in_file(file))
    except DBAPIError as error:
        raise from_database(error, str(part)) from error
    finally:
        engine.dispose()


def _forget_the_moment(connection: Connection) -> None:
    """What was going on when the backup was made is over."""
    with Session(connection) as session:
        plug = PlugState.UNKNOWN.value
        # The lowest number of all: any record of the installation itself is newer.
        session.merge(PlugRow(id=1, state=plug, corridor=None, revision=0))
        # One that was used since would let somebody in a second time.
        session.execute(delete(InvitationRow))
        open_states = [state.value for state in JobState if not state.ended]
        for row in session.scalars(select(JobRow).where(JobRow.state.in_(open_states))):
            _close(session, row)
        session.flush()


def _close(session: Session, row: JobRow) -> None:
    error = RestoredError("The backup was made while the job was running.")
    now = datetime.now(UTC)
    newest = session.scalar(
        select(func.max(JobEventRow.sequence)).where(JobEventRow.job_id == row.id)
    )
    row.state, row.updated_at = JobState.FAILED.value, now
    row.error = problem_from(error).model_dump(mode="json")
    row.needs_person = None
    session.add(
        JobEventRow(
            job_id=row.id,
            sequence=(newest or 0) + 1,
            at=now,
            kind=JobState.FAILED.value,
            phase=row.phase,
            message=error.title,
            data={"code": error.code},
        )
    )
