"""What calibration remembers between two starts."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

from server.calibration.drift.memory import DriftMemory
from server.storage.calibration_notes import CalibrationNotes
from server.storage.database import Database

NOW = datetime(2026, 3, 1, tzinfo=UTC)


async def test_the_newest_note_of_a_name_counts_and_one_of_another_release_is_none(
    tmp_path: Path,
) -> None:
    database = Database(tmp_path)
    await database.open()
    notes = CalibrationNotes(database)
    assert await notes.read("drift") is None
    await notes.write("drift", DriftMemory(jobs_at_version=3).model_dump(mode="json"), NOW)
    await notes.write("drift", DriftMemory(jobs_at_version=7).model_dump(mode="json"), NOW)
    await notes.write("routine", {"kind": "a routine that was given up"}, NOW)
    await database.close()

    database = Database(tmp_path)
    await database.open()
    notes = CalibrationNotes(database)
    kept = await notes.read_as(DriftMemory, "drift")
    assert kept == DriftMemory(jobs_at_version=7)
    assert await notes.read_as(DriftMemory, "routine") is None
    assert await notes.read("routine") == {"kind": "a routine that was given up"}
    await database.close()
