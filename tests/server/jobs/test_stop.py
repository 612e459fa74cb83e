"""A stop ends the job where it is; after a reset a person decides how to go on."""

from __future__ import annotations

import pytest

from server.control.model import PlugState, RobotMode
from server.jobs.model import JobPhase, JobState, JobType
from tests.support.garage import Scene, on_scene

DECELERATION_S = 0.5


@pytest.mark.parametrize(
    ("phase", "plug", "emergency"),
    [
        (JobPhase.ALIGNING, PlugState.FREE, True),
        (JobPhase.INSERTING, PlugState.INSERTED, False),
        (JobPhase.INSERTING, PlugState.INSERTED, True),
        (JobPhase.WITHDRAWING, PlugState.INSERTED, True),
        (JobPhase.PARKING, PlugState.FREE, False),
    ],
)
def test_a_stop_in_a_moving_phase_ends_the_job_where_it_is(
    phase: JobPhase, plug: PlugState, *, emergency: bool
) -> None:
    async def scenario(scene: Scene) -> None:
        supervisor = scene.services.supervisor
        job = await scene.start(JobType.CHARGE, 1.0)
        await scene.until_phase(phase)
        await scene.until_moving()
        await (supervisor.emergency_stop() if emergency else supervisor.stop())
        ended = await scene.ended(job)
        assert ended.state is JobState.FAILED
        assert ended.error is not None
        assert ended.error.code == ("emergency_stopped" if emergency else "stopped")
        assert supervisor.plug.state is plug
        assert supervisor.holder is None
        await scene.later(DECELERATION_S)
        assert await scene.still()

        await supervisor.reset()
        assert supervisor.mode is (RobotMode.OFF if emergency else RobotMode.READY)
        assert await scene.still()
        again = JobType.UNPLUG if plug is PlugState.INSERTED else JobType.PLUG_IN
        ended = await scene.carried_out(again)
        assert ended.error is None
        assert ended.state is JobState.SUCCEEDED
        truth = scene.truth()
        assert truth.lateral_violation_mm == 0
        assert truth.load_breaks == 0

    on_scene(scenario, seed=4)


@pytest.mark.parametrize("emergency", [False, True])
def test_a_stop_while_charging_ends_the_power_and_nothing_moves_after_the_reset(
    *, emergency: bool
) -> None:
    async def scenario(scene: Scene) -> None:
        supervisor = scene.services.supervisor
        job = await scene.start(JobType.CHARGE)
        await scene.until_phase(JobPhase.CHARGING)
        await scene.later(5.0)
        assert (await scene.station()).power_w > 1000.0
        await (supervisor.emergency_stop() if emergency else supervisor.stop())
        await scene.later(0.1)
        await supervisor.reset()  # sooner than anybody polls
        ended = await scene.ended(job)
        assert ended.error is not None
        assert ended.error.code == ("emergency_stopped" if emergency else "stopped")
        await scene.later(5.0)
        assert not (await scene.station()).carries_load
        assert await scene.still(5.0)
        assert scene.truth().seated
        assert supervisor.plug.state is PlugState.INSERTED
        assert (await scene.carried_out(JobType.UNPLUG)).state is JobState.SUCCEEDED

    on_scene(scenario, seed=4)


def test_a_stop_on_the_way_back_of_a_cancelled_job_is_told() -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.ALIGNING)
        await scene.later(1.0)
        await scene.services.runner.cancel(job.id)
        await scene.until_phase(JobPhase.PARKING)
        await scene.until_moving()
        await scene.services.supervisor.stop()
        ended = await scene.ended(job)
        assert ended.state is JobState.FAILED
        assert ended.error is not None
        assert ended.error.code == "stopped"
        assert scene.services.supervisor.plug.state is PlugState.FREE

    on_scene(scenario, seed=4)
