"""Keeps what calibration remembers between two starts: one note of each name."""

from __future__ import annotations

import logging
from datetime import datetime
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError
from sqlalchemy.orm import Session

from server.storage.calibration_tables import CalibrationNoteRow
from server.storage.database import Database

_log = logging.getLogger(__name__)

Model = TypeVar("Model", bound=BaseModel)


class CalibrationNotes:
    """Notes by name.

    Args:
        database: Where they are kept.
    """

    def __init__(self, database: Database) -> None:
        self._database = database

    async def read(self, name: str) -> dict[str, Any] | None:
        """The newest note of that name, or None."""

        def work(session: Session) -> dict[str, Any] | None:
            row = session.get(CalibrationNoteRow, name)
            return None if row is None else dict(row.content)

        return await self._database.run(work)

    async def read_as(self, model: type[Model], name: str) -> Model | None:
        """The newest note of that name; None also if another release wrote it differently.

        A note is a convenience: PlugPilot starts without it.
        """
        content = await self.read(name)
        try:
            return None if content is None else model.model_validate(content)
        except ValidationError as error:
            _log.warning("the note %s cannot be read any more: %s", name, error)
            return None

    async def write(self, name: str, content: dict[str, Any], at: datetime) -> None:
        """Keep a note in place of the last one of that name."""

        def work(session: Session) -> None:
            session.merge(CalibrationNoteRow(name=name, written_at=at, content=content))

        await self._database.run(work)
