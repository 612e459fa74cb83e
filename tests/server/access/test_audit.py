"""The audit trail: complete, in one piece, one entry for each burst, and never changed."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import replace
from pathlib import Path

import pytest
from sqlalchemy import text

from server.access.audit import BURST_S, MAX_BURSTS, AuditEntry, AuditLog, broken_links
from server.storage.database import Database
from server.storage.errors import StorageError
from server.timing import Calendar, VirtualTimeLoop

WHO = {"actor": "person: Anna", "address": "192.0.2.7"}


def with_log(
    scenario: Callable[[AuditLog, Database], Awaitable[None]], folder: Path | None = None
) -> None:
    async def main() -> None:
        database = Database(folder)
        await database.open()
        log = AuditLog(database, Calendar().now)
        try:
            await scenario(log, database)
            await log.close()
        finally:
            await database.close()

    with asyncio.Runner(loop_factory=VirtualTimeLoop) as runner:
        runner.run(main())


async def _all(log: AuditLog) -> list[AuditEntry]:
    return [entry async for entry in log.everything()]


def test_entries_are_numbered_and_chained_over_a_restart(tmp_path: Path) -> None:
    async def first(log: AuditLog, _: Database) -> None:
        for number in range(3):
            log.record("operation", **WHO, operation="createJob", number=number)

    async def second(log: AuditLog, _: Database) -> None:
        log.record("access", **WHO)
        entries = await _all(log)
        assert [entry.sequence for entry in entries] == [1, 2, 3, 4]
        assert [entry.detail.get("number") for entry in entries] == [0, 1, 2, None]
        assert list(broken_links(iter(entries))) == []
        read_again = [AuditEntry.from_json(entry.as_json()) for entry in entries]
        assert read_again == entries

    with_log(first, tmp_path)
    with_log(second, tmp_path)


@pytest.mark.parametrize("change", ["actor", "removed", "swapped", "times", "detail"])
def test_a_change_behind_its_back_is_found(change: str) -> None:
    async def scenario(log: AuditLog, _: Database) -> None:
        for number in range(5):
            log.record("operation", **WHO, number=number)
        entries = await _all(log)
        match change:
            case "actor":
                entries[2] = replace(entries[2], actor="person: Eve")
            case "removed":
                del entries[2]
            case "swapped":
                entries[2], entries[3] = entries[3], entries[2]
            case "times":
                entries[2] = replace(entries[2], times=2)
            case "detail":
                entries[2] = replace(entries[2], detail={})
        assert list(broken_links(iter(entries)))

    with_log(scenario)


@pytest.mark.parametrize("statement", ["UPDATE audit SET actor = 'Eve'", "DELETE FROM audit"])
def test_the_database_refuses_to_change_it(statement: str, tmp_path: Path) -> None:
    async def scenario(log: AuditLog, database: Database) -> None:
        log.record("operation", **WHO)
        await log.written()
        with pytest.raises(StorageError, match="append-only"):
            await database.run(lambda session: session.execute(text(statement)))

    with_log(scenario, tmp_path)


def test_a_burst_is_one_entry_and_another_that_says_how_often() -> None:
    async def scenario(log: AuditLog, _: Database) -> None:
        for _second in range(30):
            log.record_burst("refused", **WHO, operation="createJob")
            await asyncio.sleep(1)
        assert [entry.times for entry in await _all(log)] == [1]
        await asyncio.sleep(BURST_S)
        assert [entry.times for entry in await _all(log)] == [1, 29]
        await asyncio.sleep(BURST_S)
        log.record_burst("refused", **WHO, operation="createJob")
        assert [entry.times for entry in await _all(log)] == [1, 29, 1]

    with_log(scenario)


def test_many_addresses_do_not_fill_the_disk() -> None:
    async def scenario(log: AuditLog, _: Database) -> None:
        for number in range(20 * MAX_BURSTS):
            log.record_burst("pairing.refused", actor="unknown", address=f"2001:db8::{number:x}")
        await log.close()
        entries = await _all(log)
        assert len(entries) == MAX_BURSTS + 2
        assert sum(entry.times for entry in entries) == 20 * MAX_BURSTS

    with_log(scenario)


def test_what_two_programs_add_at_the_same_time_is_kept(tmp_path: Path) -> None:
    async def scenario(log: AuditLog, _: Database) -> None:
        other_database = Database(tmp_path)
        await other_database.open()
        other = AuditLog(other_database, Calendar().now)
        for number in range(20):
            (log if number % 2 else other).record("operation", **WHO, number=number)
            await asyncio.sleep(0)
        await other.close()
        await other_database.close()
        entries = await _all(log)
        assert {entry.detail["number"] for entry in entries} == set(range(20))
        assert list(broken_links(iter(entries))) == []

    with_log(scenario, tmp_path)
