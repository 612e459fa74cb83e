"""After a restart nothing is guessed: interrupted jobs are closed, and the plug is doubted."""

from __future__ import annotations

from pathlib import Path

import pytest

from server.control.model import PlugState, RobotMode
from server.jobs.errors import PlugStateError
from server.jobs.model import JobPhase, JobState, JobType
from server.schema.jobs import Job
from server.storage.errors import StorageError
from tests.support.garage import Scene, on_scene


def _interrupted_in(phase: JobPhase, folder: Path) -> Job:
    async def scenario(scene: Scene) -> Job:
        job = await scene.start(JobType.CHARGE, 500.0)
        await scene.until_phase(phase)
        await scene.until_moving()
        return job  # the scene ends here, the job does not

    return on_scene(scenario, seed=4, folder=folder)


def test_an_interrupted_job_has_failed_and_says_why(tmp_path: Path) -> None:
    interrupted = _interrupted_in(JobPhase.ALIGNING, tmp_path)

    async def scenario(scene: Scene) -> None:
        job = await scene.services.jobs.get(interrupted.id)
        assert job is not None
        assert job.state is JobState.FAILED
        assert job.error is not None
        assert job.error.code == "interrupted"
        assert "aligning" in job.error.detail
        assert scene.services.runner.newest == job
        events = await scene.events(job)
        assert [event.sequence for event in events] == list(range(1, len(events) + 1))
        assert events[-1].kind == "failed"
        assert scene.services.supervisor.plug.state is PlugState.FREE
        assert (await scene.carried_out(JobType.PLUG_IN)).error is None

    on_scene(scenario, seed=4, folder=tmp_path, parked=False)


def test_a_plug_that_was_going_in_is_unknown_until_it_was_withdrawn(tmp_path: Path) -> None:
    _interrupted_in(JobPhase.INSERTING, tmp_path)

    async def scenario(scene: Scene) -> None:
        supervisor = scene.services.supervisor
        assert supervisor.plug.state == "unknown"
        assert supervisor.mode is RobotMode.OFF
        for job_type in (JobType.PLUG_IN, JobType.CHARGE):
            with pytest.raises(PlugStateError, match="does not know"):
                await scene.start(job_type)
        job = await scene.carried_out(JobType.UNPLUG)
        assert job.error is None
        assert supervisor.plug.state is PlugState.PARKED
        assert (await scene.carried_out(JobType.PLUG_IN)).error is None

    on_scene(scenario, seed=4, folder=tmp_path, parked=False)


def test_a_plug_whose_depth_nobody_knows_is_withdrawn_along_its_axis() -> None:
    async def scenario(scene: Scene) -> None:
        await scene.carried_out(JobType.PLUG_IN)
        await scene.services.supervisor.plug.doubt()
        job = await scene.carried_out(JobType.UNPLUG)
        assert job.error is None
        truth = scene.truth()
        assert truth.lateral_violation_mm == 0
        assert truth.load_breaks == 0
        assert truth.max_contact_force_n < 85.0
        assert scene.services.supervisor.plug.state is PlugState.PARKED

    on_scene(scenario, seed=4)


def test_a_disk_that_fails_ends_the_job_in_its_place(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    async def scenario(scene: Scene) -> None:
        store = scene.services.jobs
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.ALIGNING)
        await scene.until_moving()

        async def full(*_: object) -> None:
            raise StorageError("The disk is full.")

        monkeypatch.setattr(store, "save", full)
        await scene.services.runner.wait()
        newest = scene.services.runner.newest
        assert newest is not None
        assert newest.id == job.id
        assert newest.state is JobState.FAILED
        assert newest.error is not None
        assert newest.error.code == "storage"
        assert scene.services.supervisor.holder is None
        assert await scene.still()
        assert scene.services.supervisor.plug.state is PlugState.FREE

    on_scene(scenario, seed=4, folder=tmp_path)


def test_a_phase_that_fails_in_an_unforeseen_way_ends_the_job_in_its_place(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.ALIGNING)
        monkeypatch.setattr(scene.services.runner._eye, "look", None)  # not even callable
        ended = await scene.ended(job)
        assert ended.error is not None
        assert ended.error.code == "internal"
        assert "NoneType" not in ended.error.detail
        assert "NoneType" in caplog.text
        assert scene.seen[-1] is JobPhase.ALIGNING
        assert await scene.still()

    on_scene(scenario, seed=4)
