"""Whole jobs while nothing can be kept: no plug goes in, every plug comes out, and it is told."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from sqlalchemy import text
from sqlalchemy.orm import Session

from server.control.model import PlugState
from server.control.plug_guard import HELD
from server.jobs.admission import UNKNOWN_VEHICLE, choose_vehicle
from server.jobs.errors import UnknownVehicleError
from server.jobs.model import JobPhase, JobState, JobType
from server.labels.payload import LabelKey
from server.schema.jobs import JobRequest
from server.storage.database import RETRY_S, Database
from server.storage.errors import DatabaseBrokenError, DiskFullError
from server.storage.sqlite_home import FILE_NAME, SqliteHome
from server.storage.vehicles import VehicleStore
from tests.support.garage import Scene, on_scene
from tests.support.virtual import run_virtual


def fill_up(session: Session) -> None:
    """Let the file have no more pages, as on a full disk."""
    used = session.scalar(text("PRAGMA page_count"))
    session.execute(text(f"PRAGMA max_page_count = {used}"))


async def shown(scene: Scene) -> str | None:
    """The code of the problem that everyone who watches sees."""
    snapshot = json.loads(await anext(scene.services.live.watch()))
    problem = snapshot["live"]["service"]["storage"]
    return None if problem is None else str(problem["code"])


async def lose_the_disk(scene: Scene) -> None:
    """Fill the disk and go on until somebody notices."""
    await scene.services.database.run(fill_up)
    for _ in range(50):
        await scene.services.runner.note("note", "x" * 500)
        if scene.services.database.problem is not None:
            return
    raise AssertionError("the disk is not full")


def test_a_car_is_unplugged_although_the_disk_is_full(tmp_path: Path) -> None:
    async def scenario(scene: Scene) -> None:
        database = scene.services.database
        job = await scene.start(JobType.CHARGE, 300.0)
        await scene.until_phase(JobPhase.CHARGING)
        await lose_the_disk(scene)
        assert await shown(scene) == "disk_full"
        ended = await scene.ended(job)
        assert ended.state is JobState.SUCCEEDED
        assert scene.truth().lateral_violation_mm == 0
        assert not scene.truth().seated
        # a new connection has no limit any more, as after somebody has made room
        await scene.until(lambda: database.problem is None, step_s=RETRY_S)
        assert await shown(scene) is None
        assert await scene.services.jobs.get(job.id) == ended

    on_scene(scenario, seed=4, folder=tmp_path)


def test_a_plug_that_is_not_in_yet_stays_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def still_full(_: SqliteHome) -> None:
        raise DiskFullError("The disk is full.")

    async def scenario(scene: Scene) -> None:
        monkeypatch.setattr(SqliteHome, "prepare", still_full)
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.ALIGNING)
        await lose_the_disk(scene)
        ended = await scene.ended(job)
        assert ended.error is not None
        assert ended.error.code == "disk_full"
        begun = [e.phase for e in await scene.events(job) if e.kind == "phase_started"]
        assert begun == [JobPhase.PREFLIGHT, JobPhase.LOCATING, JobPhase.ALIGNING]
        assert await scene.still()
        assert scene.services.supervisor.plug.state is PlugState.FREE
        assert scene.services.database.problem is not None
        with pytest.raises(DiskFullError):
            await scene.start(JobType.PLUG_IN)

    on_scene(scenario, seed=4, folder=tmp_path)


def test_after_a_start_with_a_damaged_database_the_car_is_unplugged(tmp_path: Path) -> None:
    async def plug_in(scene: Scene) -> None:
        assert (await scene.carried_out(JobType.PLUG_IN)).error is None

    async def unplug(scene: Scene) -> None:
        services = scene.services
        assert isinstance(services.database.problem, DatabaseBrokenError)
        assert await shown(scene) == "database_broken"
        assert services.supervisor.plug.state in HELD, "known from its own file"
        job = await scene.carried_out(JobType.UNPLUG)
        assert job.error is None
        assert services.supervisor.plug.state is PlugState.PARKED
        with pytest.raises(DatabaseBrokenError):
            await scene.start(JobType.PLUG_IN)

    on_scene(plug_in, seed=4, folder=tmp_path)
    file = tmp_path / FILE_NAME
    damaged = file.read_bytes()[: file.stat().st_size // 2]
    file.write_bytes(damaged)
    on_scene(unplug, seed=4, folder=tmp_path, parked=False)
    assert file.read_bytes() == damaged


def test_unplugging_needs_no_vehicle_that_a_damaged_database_could_have_lost() -> None:
    async def scenario() -> None:
        database = Database(None)
        await database.open()
        vehicles = VehicleStore(database, LabelKey(bytes(32)))
        unplug = JobRequest(type=JobType.UNPLUG)
        assert await choose_vehicle(unplug, vehicles, None) == (UNKNOWN_VEHICLE, None)
        with pytest.raises(UnknownVehicleError):
            await choose_vehicle(JobRequest(type=JobType.PLUG_IN), vehicles, None)
        await database.close()

    run_virtual(scenario())
