"""What a test runs in a process of its own, where the disk is small or write-protected."""

from __future__ import annotations

import asyncio
import json
import os
import resource
import sys
from collections.abc import Callable, Coroutine
from pathlib import Path
from typing import Any

from server.control.model import PlugState
from server.control.plug_guard import PlugRecord
from server.jobs.model import JobPhase, JobType
from server.storage import database as database_module
from server.storage.database import Database
from server.storage.errors import StorageError
from server.storage.jobs import JobStore
from server.storage.plug import StoredPlug
from server.storage.plug_file import PlugFile
from tests.server.storage.samples import event, job

INSERTED = PlugRecord(PlugState.INSERTED, None)
FREE = PlugRecord(PlugState.FREE, None)

Facts = dict[str, object]


async def _opened(folder: Path) -> tuple[Database, JobStore, StoredPlug]:
    database = Database(folder)
    await database.open()
    plug = StoredPlug(database, folder)
    await plug.load()
    return database, JobStore(database), plug


async def _write_until_lost(database: Database, jobs: JobStore) -> int:
    sequence = 0
    while database.problem is None and sequence < 5000:
        sequence += 1
        await jobs.save(job(1), event(sequence, "x" * 500))
    return sequence


async def _code_of(jobs: JobStore) -> str:
    try:
        await jobs.add(job(2), key=None, digest=None)
    except StorageError as error:
        return error.code
    return "accepted"


async def _unplug(jobs: JobStore) -> None:
    unplug = job(300).model_copy(update={"type": JobType.UNPLUG})
    await jobs.add(unplug, key=None, digest=None)
    for number, phase in enumerate((JobPhase.WITHDRAWING, JobPhase.PARKING), start=1):
        begun = event(number).model_copy(update={"kind": "phase_started", "phase": phase})
        await jobs.save(unplug.model_copy(update={"phase": phase}), begun)


async def full(folder: Path, filler: Path) -> Facts:
    """The disk fills up while the plug is in, and somebody makes room."""
    database, jobs, plug = await _opened(folder)
    await jobs.add(job(1), key=None, digest=None)
    await plug.save(INSERTED)
    with filler.open("wb") as file:
        try:
            while True:
                os.write(file.fileno(), bytes(1024))
        except OSError:
            pass
    written = await _write_until_lost(database, jobs)
    code = database.problem.code if database.problem else None
    refused = await _code_of(jobs)
    await _unplug(jobs)
    await plug.save(FREE)
    on_full_disk = PlugFile(folder).read()
    filler.unlink()  # noqa: ASYNC240 - this process does nothing else
    for _ in range(100):
        if database.problem is None:
            break
        await asyncio.sleep(0.05)
    caught_up = database.problem is None
    await database.close()
    database, jobs, plug = await _opened(folder)
    events = len(await jobs.events(job(1).id))
    unplugged = await jobs.get(job(300).id)
    record = await plug.load()
    await database.close()
    return {
        "code": code,
        "refused": refused,
        "plug_on_full_disk": on_full_disk.record.state.value if on_full_disk else None,
        "caught_up": caught_up,
        "events_kept": events == written,
        "unplug_kept": unplugged is not None and unplugged.phase is JobPhase.PARKING,
        "plug": record.state.value if record else None,
    }


async def limited(folder: Path) -> Facts:
    """No file may grow any more: the kernel refuses in the middle of a write."""
    database, jobs, plug = await _opened(folder)
    await jobs.add(job(1), key=None, digest=None)
    await plug.save(INSERTED)
    resource.setrlimit(resource.RLIMIT_FSIZE, (60_000, resource.RLIM_INFINITY))
    await _write_until_lost(database, jobs)
    code = database.problem.code if database.problem else None
    refused = await _code_of(jobs)
    await _unplug(jobs)
    await plug.save(FREE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
    await database.close()
    database, jobs, plug = await _opened(folder)
    record = await plug.load()
    kept = await jobs.get(job(300).id)
    await database.close()
    return {
        "code": code,
        "refused": refused,
        "unplug_kept": kept is not None,
        "plug": record.state.value if record else None,
    }


async def read_only(folder: Path) -> Facts:
    """Nothing in the folder can be written."""
    database, jobs, plug = await _opened(folder)
    record = await plug.load()
    code = database.problem.code if database.problem else None
    known = await jobs.get(job(7).id)
    refused = await _code_of(jobs)
    await _unplug(jobs)
    await plug.save(FREE)
    await database.close()
    return {
        "code": code,
        "refused": refused,
        "can_be_read": known is not None,
        "plug": record.state.value if record else None,
    }


if __name__ == "__main__":
    database_module.RETRY_S = 0.1
    name, *paths = sys.argv[1:]
    scenarios: dict[str, Callable[..., Coroutine[Any, Any, Facts]]] = {
        "full": full,
        "limited": limited,
        "read_only": read_only,
    }
    print(json.dumps(asyncio.run(scenarios[name](*map(Path, paths)))))
