"""One job may wait: for its time, or for the one that is running."""

from __future__ import annotations

import json
from datetime import UTC, datetime, timedelta
from pathlib import Path
from zoneinfo import ZoneInfo

import pytest
from pydantic import ValidationError

from server.control.model import PlugState
from server.jobs.errors import (
    JobEndedError,
    JobQueueFullError,
    NotChargingError,
    NotPausedError,
    ScheduleError,
)
from server.jobs.model import JobPhase, JobState, JobType
from server.jobs.waiting import until
from server.schema.jobs import Job, JobRequest
from server.timing import Calendar
from tests.support.garage import Scene
from tests.support.knowing_eye import on_knowing_scene
from tests.support.virtual import run_virtual


async def _asked(scene: Scene, job_type: JobType, **request: object) -> Job:
    body = JobRequest.model_validate({"type": job_type, **request})
    return await scene.services.runner.create(body, key=None, digest=None)


def _now(scene: Scene) -> datetime:
    return scene.services.calendar.now()


def _somebody_waits(scene: Scene) -> bool:
    return scene.services.runner.waiting is not None


async def _began(scene: Scene, job: Job) -> None:
    runner = scene.services.runner
    await scene.until(lambda: runner.newest is not None and runner.newest.id == job.id)
    await scene.until(lambda: runner.waiting is None)


def test_a_second_job_waits_for_the_first_and_a_third_is_refused() -> None:
    async def scenario(scene: Scene) -> None:
        runner = scene.services.runner
        first = await scene.start(JobType.PLUG_IN)
        second = await scene.start(JobType.UNPLUG)
        assert second.state is JobState.QUEUED
        assert runner.newest is not None
        assert runner.newest.id == first.id
        with pytest.raises(JobQueueFullError) as refusal:
            await scene.start(JobType.PLUG_IN)
        assert refusal.value.context["job_id"] == second.id
        assert (await scene.ended(first)).state is JobState.SUCCEEDED
        await _began(scene, second)
        assert (await scene.ended(second)).state is JobState.SUCCEEDED
        assert scene.services.supervisor.plug.state is PlugState.PARKED

    on_knowing_scene(scenario, seed=4)


def test_who_watches_sees_the_job_that_waits() -> None:
    async def scenario(scene: Scene) -> None:
        messages = scene.services.live.watch()
        live = json.loads(await anext(messages))["live"]
        assert live["queue"] == {"waiting": None}
        first = await scene.start(JobType.PLUG_IN)
        second = await scene.start(JobType.UNPLUG)
        while live["queue"]["waiting"] is None:
            live |= json.loads(await anext(messages))["changes"]
        assert live["queue"]["waiting"]["id"] == second.id
        assert live["job"]["id"] == first.id
        while live["job"]["id"] == first.id:
            live |= json.loads(await anext(messages))["changes"]
        assert live["job"]["id"] == second.id
        assert live["queue"] == {"waiting": None}
        await scene.ended(second)

    on_knowing_scene(scenario, seed=4)


def test_what_is_impossible_when_its_turn_comes_fails_in_words() -> None:
    async def scenario(scene: Scene) -> None:
        first = await scene.start(JobType.PLUG_IN)
        second = await scene.start(JobType.PLUG_IN)
        await scene.ended(first)
        await scene.until(lambda: scene.services.runner.waiting is None)
        await scene.later(0.1)
        failed = await scene.services.jobs.get(second.id)
        assert failed is not None
        assert failed.error is not None
        assert failed.error.code == "plug_state"
        assert scene.truth().seated

    on_knowing_scene(scenario, seed=4)


def test_a_waiting_job_can_be_paused_resumed_and_cancelled() -> None:
    async def scenario(scene: Scene) -> None:
        runner = scene.services.runner
        first = await scene.start(JobType.PLUG_IN)
        second = await scene.start(JobType.UNPLUG)
        with pytest.raises(NotPausedError):
            await runner.resume(second.id)
        with pytest.raises(NotChargingError):
            await runner.finish(second.id)
        assert (await runner.pause(second.id)).paused
        await scene.ended(first)
        await scene.later(30.0)
        assert _somebody_waits(scene)
        assert scene.truth().seated
        assert not (await runner.resume(second.id)).paused
        await _began(scene, second)
        assert (await scene.ended(second)).state is JobState.SUCCEEDED

        later = _now(scene) + timedelta(hours=5)
        third = await _asked(scene, JobType.PLUG_IN, not_before=later)
        assert (await runner.cancel(third.id)).state is JobState.CANCELLED
        assert not _somebody_waits(scene)
        with pytest.raises(JobEndedError):
            await runner.cancel(third.id)
        assert (await scene.kinds(third)) == ["cancel_requested", "cancelled"]

    on_knowing_scene(scenario, seed=4)


def test_a_job_begins_at_its_time_and_others_may_run_before() -> None:
    async def scenario(scene: Scene) -> None:
        at = _now(scene) + timedelta(seconds=100)
        late = await _asked(scene, JobType.UNPLUG, not_before=at)
        assert late.state is JobState.QUEUED
        now = await scene.carried_out(JobType.PLUG_IN)
        assert now.state is JobState.SUCCEEDED
        await _began(scene, late)
        assert abs((_now(scene) - at).total_seconds()) < 1.0
        assert (await scene.ended(late)).state is JobState.SUCCEEDED

    on_knowing_scene(scenario, seed=4)


def test_a_car_is_unplugged_by_its_time() -> None:
    async def scenario(scene: Scene) -> None:
        by = _now(scene) + timedelta(seconds=150)
        job = await _asked(scene, JobType.CHARGE, unplug_by=by)
        ended = await scene.ended(job)
        assert ended.state is JobState.SUCCEEDED
        assert ended.unplug_by == by
        assert timedelta(0) < by - ended.updated_at < timedelta(seconds=100)
        messages = [event.message for event in await scene.events(job)]
        assert "It is time to unplug." in messages

    on_knowing_scene(scenario, seed=4)


def test_a_schedule_survives_a_restart(tmp_path: Path) -> None:
    async def before(scene: Scene) -> Job:
        at = _now(scene) + timedelta(seconds=60)
        return await _asked(scene, JobType.PLUG_IN, not_before=at)

    job = on_knowing_scene(before, seed=4, folder=tmp_path)

    async def after(scene: Scene) -> None:
        assert scene.services.runner.waiting is not None
        await _began(scene, job)
        assert (await scene.ended(job)).state is JobState.SUCCEEDED

    on_knowing_scene(after, seed=4, folder=tmp_path, parked=False)


def test_a_schedule_that_the_power_cut_has_eaten_is_missed(tmp_path: Path) -> None:
    async def before(scene: Scene) -> Job:
        now = _now(scene)
        times = {"not_before": now + timedelta(hours=1), "unplug_by": now + timedelta(hours=2)}
        return await _asked(scene, JobType.CHARGE, **times)

    job = on_knowing_scene(before, seed=4, folder=tmp_path)

    async def after(scene: Scene) -> None:
        scene.services.calendar._origin += timedelta(hours=3)
        await scene.until(lambda: scene.services.runner.waiting is None)
        await scene.later(0.1)
        missed = await scene.services.jobs.get(job.id)
        assert missed is not None
        assert missed.error is not None
        assert missed.error.code == "schedule_missed"

    on_knowing_scene(after, seed=4, folder=tmp_path)


def test_times_that_cannot_be_kept_are_refused() -> None:
    async def scenario(scene: Scene) -> None:
        now = _now(scene)
        hour = timedelta(hours=1)
        with pytest.raises(ScheduleError, match="is over"):
            await _asked(scene, JobType.CHARGE, unplug_by=now - hour)
        with pytest.raises(ScheduleError, match="before the job may begin"):
            await _asked(scene, JobType.CHARGE, not_before=now + hour, unplug_by=now + hour / 2)
        assert scene.services.runner.waiting is None

    on_knowing_scene(scenario, seed=4)


@pytest.mark.parametrize(
    "body",
    [
        {"type": "plug_in", "unplug_by": "2030-01-01T06:00:00Z"},
        {"type": "charge", "not_before": "2030-01-01T06:00:00"},  # whose time?
        {"type": "charge", "not_before": "0001-01-01T00:00:00+23:00"},
        {"type": "charge", "not_before": "tomorrow"},
    ],
)
def test_a_schedule_names_one_instant(body: dict[str, str]) -> None:
    with pytest.raises(ValidationError):
        JobRequest.model_validate(body)


def test_the_two_half_past_twos_of_the_last_october_night_are_two_instants() -> None:
    berlin = ZoneInfo("Europe/Berlin")
    first = datetime(2026, 10, 25, 2, 30, tzinfo=berlin, fold=0)
    second = first.replace(fold=1)
    requests = [JobRequest(type=JobType.CHARGE, not_before=at) for at in (first, second)]
    early, late = (request.not_before for request in requests)
    assert early is not None
    assert late is not None
    assert late - early == timedelta(hours=1)
    assert early.tzinfo is UTC


@pytest.mark.parametrize("step", [timedelta(minutes=30), timedelta(minutes=-30)])
def test_a_clock_that_is_set_is_obeyed(step: timedelta) -> None:
    async def main() -> float:
        calendar = Calendar()
        at = calendar.now() + timedelta(hours=1)
        loop_s = calendar._loop.time
        calendar._loop.call_later(60.0, _set, calendar, step)
        await until(at, calendar)
        return loop_s()

    assert run_virtual(main()) == pytest.approx(3600.0 - step.total_seconds(), abs=11.0)


def _set(calendar: Calendar, step: timedelta) -> None:
    calendar._origin += step


def test_a_technician_is_not_disturbed_by_a_schedule() -> None:
    async def scenario(scene: Scene) -> None:
        supervisor = scene.services.supervisor
        job = await _asked(scene, JobType.PLUG_IN, not_before=_now(scene) + timedelta(seconds=10))
        async with supervisor.control("jog", "A technician"):
            await scene.later(30.0)
            assert scene.services.runner.waiting is not None
        await _began(scene, job)
        assert (await scene.ended(job)).state is JobState.SUCCEEDED
        assert (await scene.kinds(job)).count("waits") == 1
        assert scene.seen[-1] is JobPhase.PLUGGED

    on_knowing_scene(scenario, seed=4)
