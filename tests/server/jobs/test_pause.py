"""A paused job rests until somebody resumes it: nothing moves, and no car gets power."""

from __future__ import annotations

import pytest

from server.control.errors import ControlBusyError
from server.control.model import PlugState
from server.jobs.errors import CannotPauseError, NotPausedError
from server.jobs.model import JobPhase, JobState, JobType
from server.schema.jobs import Job
from tests.support.garage import Scene
from tests.support.knowing_eye import on_knowing_scene

RESTING_S = 40.0


async def _paused(scene: Scene, job: Job) -> Job:
    runner = scene.services.runner
    await runner.pause(job.id)
    await scene.until(lambda: runner.newest is not None and runner.newest.paused)
    kept = await scene.services.jobs.get(job.id)
    assert kept is not None
    assert kept.paused
    assert kept.state is JobState.RUNNING
    return kept


@pytest.mark.parametrize(
    ("phase", "after_s"),
    [
        (JobPhase.PREFLIGHT, 0.05),
        (JobPhase.ALIGNING, 0.5),
        (JobPhase.INSERTING, 4.0),  # the contacts touch
        (JobPhase.PARKING, 0.5),
    ],
)
def test_a_job_paused_while_it_moves_rests_and_then_finishes(
    phase: JobPhase, after_s: float
) -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.start(JobType.CHARGE, 20.0)
        await scene.until_phase(phase)
        await scene.later(after_s)
        await _paused(scene, job)
        assert await scene.still(RESTING_S)
        holder = scene.services.supervisor.holder
        assert holder is not None
        assert holder.name == "Charging job, paused"
        await scene.services.runner.resume(job.id)
        ended = await scene.ended(job)
        assert ended.error is None
        assert not ended.paused
        assert scene.services.supervisor.plug.state is PlugState.PARKED
        truth = scene.truth()
        assert truth.lateral_violation_mm == 0
        assert truth.load_breaks == 0

    on_knowing_scene(scenario, seed=4)


def test_a_paused_car_gets_no_power_and_then_the_rest_of_its_energy() -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.start(JobType.CHARGE, 60.0)
        await scene.until_phase(JobPhase.CHARGING)
        await scene.later(15.0)
        await _paused(scene, job)
        await scene.later(3.0)
        snapshot = await scene.station()
        assert snapshot.held
        assert not snapshot.carries_load
        before_wh = snapshot.session_energy_wh
        assert 10.0 < before_wh < 50.0
        await scene.later(RESTING_S)  # longer than a car is waited for that wants no more
        assert (await scene.station()).session_energy_wh == pytest.approx(before_wh, abs=0.1)
        await scene.services.runner.resume(job.id)
        ended = await scene.ended(job)
        assert ended.state is JobState.SUCCEEDED
        assert ended.result.energy_wh == pytest.approx(60.0, abs=6.0)
        assert (await scene.kinds(job)).count("charging_started") == 1

    on_knowing_scene(scenario, seed=4)


def test_a_pause_without_an_answer_of_the_station_is_none() -> None:
    async def scenario(scene: Scene) -> None:
        runner = scene.services.runner
        job = await scene.start(JobType.CHARGE, 60.0)
        await scene.until_phase(JobPhase.CHARGING)
        await scene.later(5.0)
        scene.garage.station.hang()
        await runner.pause(job.id)
        await scene.later(3.1)
        scene.garage.station.behave()
        ended = await scene.ended(job)
        assert ended.state is JobState.SUCCEEDED
        kinds = await scene.kinds(job)
        assert "pause_failed" in kinds
        assert "paused" not in kinds

    on_knowing_scene(scenario, seed=4)


def test_a_plug_on_its_way_out_is_not_paused() -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.start(JobType.CHARGE, 5.0)
        for phase in (JobPhase.RELEASING, JobPhase.WITHDRAWING):
            await scene.until_phase(phase)
            with pytest.raises(CannotPauseError):
                await scene.services.runner.pause(job.id)
        with pytest.raises(NotPausedError):
            await scene.services.runner.resume(job.id)
        assert (await scene.ended(job)).state is JobState.SUCCEEDED

    on_knowing_scene(scenario, seed=4)


@pytest.mark.parametrize("phase", [JobPhase.ALIGNING, JobPhase.INSERTING, JobPhase.CHARGING])
def test_a_paused_job_can_be_cancelled(phase: JobPhase) -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.start(JobType.CHARGE)
        await scene.until_phase(phase)
        await scene.later(1.0)
        await _paused(scene, job)
        await scene.services.runner.cancel(job.id)
        ended = await scene.ended(job)
        assert ended.state is JobState.CANCELLED
        assert not ended.paused
        assert scene.services.supervisor.plug.state is PlugState.PARKED
        assert not (await scene.station()).held

    on_knowing_scene(scenario, seed=4)


def test_a_stop_ends_a_paused_job() -> None:
    async def scenario(scene: Scene) -> None:
        supervisor = scene.services.supervisor
        job = await scene.start(JobType.CHARGE)
        await scene.until_phase(JobPhase.CHARGING)
        await scene.later(5.0)
        await _paused(scene, job)
        await supervisor.stop()
        ended = await scene.ended(job)
        assert ended.error is not None
        assert ended.error.code == "stopped"
        assert supervisor.holder is None
        assert "turned_back" in await scene.kinds(job)

    on_knowing_scene(scenario, seed=4)


def test_the_charging_of_a_paused_job_can_be_finished() -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.start(JobType.CHARGE)
        await scene.until_phase(JobPhase.CHARGING)
        await scene.later(5.0)
        await _paused(scene, job)
        await scene.services.runner.finish(job.id)
        ended = await scene.ended(job)
        assert ended.state is JobState.SUCCEEDED
        assert scene.services.supervisor.plug.state is PlugState.PARKED

    on_knowing_scene(scenario, seed=4)


def test_nobody_else_moves_a_robot_whose_job_is_paused() -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.ALIGNING)
        await _paused(scene, job)
        with pytest.raises(ControlBusyError, match="Plug-in job, paused"):
            scene.services.supervisor.acquire("jog", "A technician")
        await scene.services.runner.resume(job.id)
        assert (await scene.ended(job)).state is JobState.SUCCEEDED

    on_knowing_scene(scenario, seed=4)
