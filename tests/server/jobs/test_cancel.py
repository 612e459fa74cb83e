"""Cancelling brings plug and robot back to safety, from wherever they are."""

from __future__ import annotations

import pytest

from server.control.model import PlugState, RobotMode
from server.jobs.errors import JobEndedError, JobNotFoundError, NotChargingError
from server.jobs.model import JobPhase, JobState, JobType
from tests.support.garage import Scene, on_scene, shift_car


async def _assert_back(scene: Scene) -> None:
    supervisor = scene.services.supervisor
    assert supervisor.plug.state is PlugState.PARKED
    assert supervisor.holder is None
    assert await scene.still()
    truth = scene.truth()
    assert truth.insertion_depth_mm < -10.0
    assert truth.lateral_violation_mm == 0
    assert truth.load_breaks == 0
    assert not (await scene.station()).held


@pytest.mark.parametrize(
    ("phase", "after_s", "energy_wh"),
    [
        (JobPhase.PREFLIGHT, 0.0, None),
        (JobPhase.ALIGNING, 0.5, None),  # on the way
        (JobPhase.INSERTING, 4.0, None),  # the contacts touch
        (JobPhase.CHARGING, 5.0, 500.0),  # power flows
    ],
)
def test_a_cancelled_job_ends_parked(
    phase: JobPhase, after_s: float, energy_wh: float | None
) -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.start(JobType.CHARGE, energy_wh)
        await scene.until_phase(phase)
        await scene.later(after_s)
        assert scene.seen[-1] is phase
        assert (await scene.services.runner.cancel(job.id)).cancel_requested
        ended = await scene.ended(job)
        assert ended.state is JobState.CANCELLED
        assert ended.cancel_requested
        assert ended.error is None
        await _assert_back(scene)

    on_scene(scenario, seed=4)


def test_cancelling_while_homing_leaves_the_robot_still() -> None:
    async def scenario(scene: Scene) -> None:
        supervisor = scene.services.supervisor
        job = await scene.start(JobType.PLUG_IN)
        await scene.until(lambda: supervisor.mode is RobotMode.HOMING)
        await scene.later(1.0)
        await scene.services.runner.cancel(job.id)
        assert (await scene.ended(job)).state is JobState.CANCELLED
        assert (await scene.events(job))[-1].message.endswith("stays where it is.")
        assert await scene.still(2.0)
        assert supervisor.mode is RobotMode.NOT_HOMED
        assert supervisor.holder is None

    on_scene(scenario, seed=4, parked=False)


def test_cancelling_while_measuring_ends_parked() -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.ALIGNING)
        await scene.until_moving()
        await scene.until_at_rest()
        assert scene.seen[-1] is JobPhase.ALIGNING
        await scene.services.runner.cancel(job.id)
        assert (await scene.ended(job)).state is JobState.CANCELLED
        await _assert_back(scene)

    on_scene(scenario, seed=4)


def test_cancelling_between_two_looks_ends_parked() -> None:
    async def scenario(scene: Scene) -> None:
        shift_car(scene.garage, y_mm=90.0)
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.LOCATING)
        await scene.until_moving()
        await scene.services.runner.cancel(job.id)
        assert (await scene.ended(job)).state is JobState.CANCELLED
        assert scene.seen[-1] is JobPhase.PARKING
        await _assert_back(scene)

    on_scene(scenario, seed=1)


def test_unplugging_can_be_given_up_until_the_plug_moves() -> None:
    async def scenario(scene: Scene) -> None:
        runner = scene.services.runner
        await scene.carried_out(JobType.PLUG_IN)
        job = await scene.start(JobType.UNPLUG)
        await scene.until_phase(JobPhase.RELEASING)
        await scene.later(0.2)
        await runner.cancel(job.id)
        ended = await scene.ended(job)
        assert ended.state is JobState.CANCELLED
        assert scene.services.supervisor.plug.state is PlugState.INSERTED
        assert scene.truth().seated
        assert not (await scene.station()).held

        job = await scene.start(JobType.UNPLUG)
        await scene.until_phase(JobPhase.WITHDRAWING)
        await scene.until_moving()
        await runner.cancel(job.id)  # too late: it is on its way back
        assert (await scene.ended(job)).state is JobState.SUCCEEDED
        await _assert_back(scene)

    on_scene(scenario, seed=4)


def test_a_cancelled_job_that_cannot_come_back_has_failed() -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.INSERTING)
        await scene.later(1.0)
        scene.garage.station.hang()
        await scene.services.runner.cancel(job.id)
        ended = await scene.ended(job)
        assert ended.state is JobState.FAILED
        assert ended.error is not None
        assert ended.error.code == "station_unsafe"
        assert "retreat_failed" in await scene.kinds(job)
        assert scene.services.supervisor.plug.state is PlugState.INSERTED

    on_scene(scenario, seed=4)


def test_what_has_ended_or_never_was_cannot_be_cancelled() -> None:
    async def scenario(scene: Scene) -> None:
        runner = scene.services.runner
        job = await scene.start(JobType.PLUG_IN)
        with pytest.raises(NotChargingError):
            await runner.finish(job.id)
        await runner.cancel(job.id)
        await runner.cancel(job.id)
        await scene.ended(job)
        assert (await scene.kinds(job)).count("cancel_requested") == 1
        with pytest.raises(JobEndedError, match="was cancelled"):
            await runner.cancel(job.id)
        with pytest.raises(JobNotFoundError):
            await runner.cancel("0")

    on_scene(scenario, seed=4)
