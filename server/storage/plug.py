"""Keeps where the plug is: in a file of its own and in the database, and believes the newer one."""

from __future__ import annotations

import logging
from dataclasses import asdict
from pathlib import Path

from sqlalchemy.orm import Session

from server.control.model import PlugState
from server.control.plug_guard import HELD, Corridor, PlugRecord
from server.storage.database import Database
from server.storage.errors import StorageError
from server.storage.plug_file import DamagedPlugFileError, NumberedRecord, PlugFile
from server.storage.tables import PlugRow
from server.storage.trouble import from_system

_log = logging.getLogger(__name__)

ONLY_ROW = 1

UNKNOWN = PlugRecord(PlugState.UNKNOWN, None)


class StoredPlug:
    """The plug record on disk (the PlugStore of the plug guard).

    Args:
        database: Of the installation.
        folder: The data folder; None keeps the record in the database alone.
    """

    def __init__(self, database: Database, folder: Path | None = None) -> None:
        self._database = database
        self._file = PlugFile(folder) if folder is not None else None
        self._revision = 0

    async def load(self) -> PlugRecord | None:
        """The last record, or None on a new installation.

        What cannot be read counts as unknown, never as free.
        """
        in_row = await self._database.run(_read_row)
        try:
            in_file = await self._database.in_order(self._read_file)
        except (DamagedPlugFileError, OSError) as error:
            _log.error("%s cannot be read: %r", self._file and self._file.path, error)
            self._revision = in_row.revision if in_row else 0
            return UNKNOWN
        records = [record for record in (in_row, in_file) if record is not None]
        if not records:
            return UNKNOWN if self._lost_its_row() else None
        newest = max(records, key=lambda numbered: numbered.revision)
        self._revision = newest.revision
        if in_file is None:  # an installation from before there was the file
            await self._database.in_order(lambda: self._write_file(newest))
        return newest.record

    async def save(self, record: PlugRecord) -> None:
        """Write the record down; returns when it is safe on disk.

        That the plug is free may get lost: after a power cut it then still counts as inserted.

        Raises:
            StorageError: that the plug is held, or may be, could not be written anywhere.
        """
        self._revision += 1
        numbered = NumberedRecord(record, self._revision)
        trouble = await self._database.in_order(lambda: self._write_file(numbered))
        try:
            await self._database.run(lambda session: _write_row(session, numbered))
        except StorageError as error:
            trouble = trouble and error
        else:
            trouble = trouble and self._database.problem
        if trouble is not None:
            _log.error("where the plug is cannot be written down: %s", trouble.detail)
            if record.state in HELD:
                raise trouble

    def _lost_its_row(self) -> bool:
        """The database has worked before, and its record cannot be read."""
        return self._database.problem is not None

    def _read_file(self) -> NumberedRecord | None:
        return self._file.read() if self._file else None

    def _write_file(self, numbered: NumberedRecord) -> StorageError | None:
        """Why it could not be written. Without a file the database alone counts."""
        if self._file is None:
            return StorageError("There is no data folder.")
        try:
            self._file.write(numbered)
        except OSError as error:
            return from_system(error, str(self._file.path))
        return None


def _read_row(session: Session) -> NumberedRecord | None:
    row = session.get(PlugRow, ONLY_ROW)
    if row is None:
        return None
    corridor = Corridor(**row.corridor) if row.corridor else None
    return NumberedRecord(PlugRecord(PlugState(row.state), corridor), row.revision)


def _write_row(session: Session, numbered: NumberedRecord) -> None:
    record = numbered.record
    session.merge(
        PlugRow(
            id=ONLY_ROW,
            state=record.state.value,
            corridor=asdict(record.corridor) if record.corridor else None,
            revision=numbered.revision,
        )
    )
