"""A copy a day, also while PlugPilot runs for weeks."""

from __future__ import annotations

import asyncio
import sqlite3
from contextlib import closing
from datetime import timedelta
from itertools import pairwise
from pathlib import Path

from server.storage.backups import Backups
from server.storage.daily_backups import DailyBackups
from server.storage.database import Database
from server.storage.jobs import JobStore
from server.timing import Calendar
from tests.server.storage.samples import healthy, job
from tests.support.virtual import run_virtual

DAY_S = 24 * 3600.0


def test_copies_are_also_made_while_plugpilot_runs_for_weeks(tmp_path: Path) -> None:
    healthy(tmp_path)

    async def scenario() -> None:
        database = Database(tmp_path, backups_kept=5)
        await database.open()
        calendar = Calendar()
        began = calendar.now()
        daily = DailyBackups(database, calendar)
        daily.start()
        jobs = JobStore(database)
        for week in range(3):
            await asyncio.sleep(7 * DAY_S)
            await jobs.add(job(100 + week), key=None, digest=None)
            ages = [calendar.now() - backup.made_at for backup in Backups(tmp_path, 5).all()]
            assert len(ages) == 5
            assert ages[0] <= timedelta(days=1, hours=1)
            assert max(b - a for a, b in pairwise(ages)) < timedelta(days=1, hours=2)
        assert calendar.now() - began > timedelta(days=20)
        await asyncio.sleep(2 * DAY_S)
        newest = Backups(tmp_path, 5).newest()
        assert newest is not None
        with closing(sqlite3.connect(newest.path)) as copy:
            assert copy.execute("SELECT count(*) FROM jobs").fetchone() == (33,)
        await daily.close()
        await database.close()

    run_virtual(scenario())


def test_no_copy_is_made_of_a_database_that_is_lost(tmp_path: Path) -> None:
    file = healthy(tmp_path)

    async def scenario() -> None:
        database = Database(tmp_path, backups_kept=5)
        await database.open()
        before = [backup.path for backup in Backups(tmp_path, 5).all()]
        file.write_bytes(b"shopping list\n" * 1000)
        daily = DailyBackups(database, Calendar())
        daily.start()
        await asyncio.sleep(3 * DAY_S)
        assert [backup.path for backup in Backups(tmp_path, 5).all()] == before
        assert len(before) == 1
        await daily.close()
        await database.close()

    run_virtual(scenario())
