"""After a restart nothing is guessed: jobs go on by evidence, or ask a person."""

from __future__ import annotations

import asyncio
from pathlib import Path

import pytest

from drivers.robot import NotConnectedError, RobotIdentity
from drivers.simulator.robot import SimulatedRobot
from server.config.jobs import JobSettings
from server.config.settings import Settings
from server.control.errors import ControlBusyError
from server.control.model import PlugState
from server.jobs.errors import JobWaitsForPersonError
from server.jobs.model import JobPhase, JobState, JobType
from server.schema.jobs import Job
from server.storage.errors import StorageError
from tests.support.garage import Scene, on_scene
from tests.support.knowing_eye import on_knowing_scene


def _interrupted_in(phase: JobPhase, folder: Path) -> Job:
    async def scenario(scene: Scene) -> Job:
        job = await scene.start(JobType.CHARGE, 30.0)
        await scene.until_phase(phase)
        await scene.until_moving()
        return job  # the scene ends here, the job does not

    return on_knowing_scene(scenario, seed=4, folder=folder)


def test_an_interrupted_job_goes_on_and_says_how(tmp_path: Path) -> None:
    interrupted = _interrupted_in(JobPhase.ALIGNING, tmp_path)

    async def scenario(scene: Scene) -> None:
        job = await scene.ended(interrupted)
        assert job.state is JobState.SUCCEEDED
        events = await scene.events(job)
        assert [event.sequence for event in events] == list(range(1, len(events) + 1))
        [resumed] = [event for event in events if event.kind == "resumed"]
        assert resumed.phase is JobPhase.ALIGNING
        assert "restarted in the phase aligning" in resumed.message
        assert "begins anew" in resumed.message
        assert scene.services.supervisor.plug.state is PlugState.PARKED

    on_scene(scenario, seed=4, folder=tmp_path, parked=False)


def test_a_plug_that_was_going_in_comes_out_before_it_goes_in_again(tmp_path: Path) -> None:
    interrupted = _interrupted_in(JobPhase.INSERTING, tmp_path)

    async def scenario(scene: Scene) -> None:
        supervisor = scene.services.supervisor
        assert supervisor.plug.state == "unknown"
        await scene.until_phase(JobPhase.WITHDRAWING)
        job = await scene.ended(interrupted)
        assert job.state is JobState.SUCCEEDED
        assert (job.result.energy_wh or 0.0) >= 30.0
        truth = scene.truth()
        assert truth.lateral_violation_mm == 0
        assert truth.load_breaks == 0

    on_scene(scenario, seed=4, folder=tmp_path, parked=False)


def test_a_job_waits_for_a_robot_that_does_not_answer(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    interrupted = _interrupted_in(JobPhase.ALIGNING, tmp_path)
    connect = SimulatedRobot.connect

    async def late(robot: SimulatedRobot) -> RobotIdentity:
        if asyncio.get_running_loop().time() < 30.0:
            raise NotConnectedError("There is no board.")
        return await connect(robot)

    async def scenario(scene: Scene) -> None:
        await scene.later(20.0)
        job = await scene.services.jobs.get(interrupted.id)
        assert job is not None
        assert job.needs_person is not None
        assert job.needs_person.code == "robot_offline"
        assert job.needs_person.choices == []
        assert job.state is JobState.RUNNING
        ended = await scene.ended(interrupted)
        assert ended.needs_person is None
        assert ended.state is JobState.SUCCEEDED

    monkeypatch.setattr(SimulatedRobot, "connect", late)
    on_knowing_scene(scenario, seed=4, folder=tmp_path, parked=False)


def test_what_a_job_asks_stays_open_and_can_be_answered(
    tmp_path: Path,
) -> None:
    interrupted = _interrupted_in(JobPhase.ALIGNING, tmp_path)
    asked: list[str] = []

    async def scenario(scene: Scene) -> None:
        runner = scene.services.runner
        await scene.until(lambda: runner.newest is not None and bool(runner.newest.needs_person))
        assert runner.newest is not None
        assert runner.newest.needs_person is not None
        asked.append(runner.newest.needs_person.sentence)
        assert scene.services.supervisor.holder is None  # whoever answers may move the robot first
        with pytest.raises(JobWaitsForPersonError):
            await scene.start(JobType.PLUG_IN)
        if len(asked) == 1:
            return  # another restart
        async with scene.services.supervisor.control("jog", "A technician"):
            with pytest.raises(ControlBusyError):
                await runner.resume(interrupted.id)
        await runner.resume(interrupted.id)
        job = await scene.ended(interrupted)
        assert job.state is JobState.SUCCEEDED
        assert job.needs_person is None

    patient = Settings(jobs=JobSettings(max_resumptions=0))
    on_knowing_scene(scenario, seed=4, folder=tmp_path, parked=False, settings=patient)
    on_knowing_scene(scenario, seed=4, folder=tmp_path, parked=False, settings=patient)
    assert asked[0] == asked[1]


def test_a_job_that_asks_can_be_cancelled(tmp_path: Path) -> None:
    interrupted = _interrupted_in(JobPhase.INSERTING, tmp_path)

    async def scenario(scene: Scene) -> None:
        runner = scene.services.runner
        await scene.until(lambda: runner.newest is not None and bool(runner.newest.needs_person))
        await runner.cancel(interrupted.id)
        job = await scene.ended(interrupted)
        assert job.state is JobState.CANCELLED
        assert scene.services.supervisor.plug.state is PlugState.PARKED
        assert scene.truth().lateral_violation_mm == 0

    patient = Settings(jobs=JobSettings(max_resumptions=0))
    on_knowing_scene(scenario, seed=4, folder=tmp_path, parked=False, settings=patient)


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
