"""Which events a job, a stop and a fault make."""

from __future__ import annotations

from collections import Counter

from server.jobs.model import JobState, JobType
from server.schema.events import JobEnded, NeedsPersonEvent, PlugChanged, RobotFaultEvent
from tests.support.garage import Scene, on_scene


def types(scene: Scene) -> list[str]:
    return [told.event.type for told in scene.services.events.known]


def test_a_whole_job_is_told_step_by_step() -> None:
    async def scenario(scene: Scene) -> None:
        before = len(types(scene))
        job = await scene.carried_out(JobType.PLUG_IN)
        told = scene.services.events.known[before:]
        kinds = [entry.event.type for entry in told]
        assert kinds[0] == "job.created"
        assert kinds[-1] == "job.ended"
        count = Counter(kinds)
        assert (count["job.created"], count["job.ended"]) == (1, 1)
        assert count["job.phase"] == 5
        plugs = [e.event.data.plug.value for e in told if isinstance(e.event, PlugChanged)]
        assert plugs[-1] == "inserted"
        assert plugs == list(dict.fromkeys(plugs)), "only changes are told"
        (ended,) = [e.event for e in told if isinstance(e.event, JobEnded)]
        assert ended.data.job.id == job.id
        assert ended.data.job.state is JobState.SUCCEEDED
        ids = [e.event.id for e in told]
        assert ids == sorted(set(ids))

    on_scene(scenario)


def test_pause_and_resume_are_told() -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.start(JobType.CHARGE)
        await scene.until(lambda: scene.truth().seated)
        await scene.later(15.0)
        await scene.services.runner.pause(job.id)
        await scene.later(5.0)
        await scene.services.runner.resume(job.id)
        await scene.later(5.0)
        assert types(scene).count("job.state") == 2

    on_scene(scenario)


def test_an_emergency_stop_needs_a_person_until_it_is_released() -> None:
    async def scenario(scene: Scene) -> None:
        await scene.services.supervisor.emergency_stop()
        await scene.later(1.0)
        told = [entry.event for entry in scene.services.events.known]
        faults = [event for event in told if isinstance(event, RobotFaultEvent)]
        assert [event.data.fault.code for event in faults] == ["emergency_stop"]
        assert faults[0].data.fault.remedy
        await scene.services.supervisor.reset()
        await scene.later(2.0)
        told = [entry.event for entry in scene.services.events.known]
        needs = [event.data.needed for event in told if isinstance(event, NeedsPersonEvent)]
        assert needs == [True, False]

    on_scene(scenario)
