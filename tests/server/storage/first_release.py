"""A database as the first release left it: ``data/first_release.sql`` was dumped from one.

It knew no migrations. In it are two vehicles; a charging job that succeeded, a cancelled one, and
one that a power cut interrupted while the car was charging, so the plug is in the car.
"""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path

from server.storage.sqlite_home import FILE_NAME

DUMP = Path(__file__).parent / "data" / "first_release.sql"

SUCCEEDED = "01a201a5-10af-7403-b9ae-6931dd6f9789"
CANCELLED = "01a201a5-168c-7fb0-a85b-81c28c7f0a2c"
INTERRUPTED = "01a201a5-16d5-748a-b774-3ba99575df59"
EVENTS = 34


def first_release(folder: Path) -> Path:
    """Put such a database into a data folder and return its file."""
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / FILE_NAME
    with closing(sqlite3.connect(file)) as connection:
        connection.executescript(DUMP.read_text(encoding="utf-8"))
        connection.execute("PRAGMA journal_mode = WAL")
    return file
