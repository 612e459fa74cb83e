"""What is foretold of whole jobs, beside what then really happened."""

from __future__ import annotations

import asyncio
import json
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

import pytest

from server.config.phase_times import PhaseTimeSettings
from server.config.settings import Settings
from server.jobs.model import JobPhase, JobState, JobType, Milestone
from server.schema.jobs import Job, JobEvent
from server.schema.outlook import Outlook
from tests.support.garage import Scene
from tests.support.knowing_eye import on_knowing_scene

REACHED = {
    "seated": Milestone.PLUGGED,
    "charging_done": Milestone.CHARGED,
    "succeeded": Milestone.UNPLUGGED,
    "cancelled": Milestone.UNPLUGGED,
}
WRONG = Settings(phase_times=PhaseTimeSettings(inserting_s=60.0, parking_s=90.0))
"""A robot that takes quite another time than one as drawn."""


@dataclass(frozen=True)
class Said:
    """What was foretold in a phase."""

    at: datetime
    phase: JobPhase
    outlook: Outlook | None


def _listening(scene: Scene) -> list[Said]:
    """Everything that is foretold from now on, at every entry and every reading."""
    said: list[Said] = []
    services = scene.services

    def note() -> None:
        job = services.runner.newest
        if job is not None and not job.state.ended:
            said.append(Said(services.calendar.now(), job.phase, services.outlook.now()))

    services.outlook.listen(note)
    return said


def _errors_s(said: list[Said], events: list[JobEvent]) -> dict[JobPhase, float]:
    """The largest error of what was foretold in each phase [s]."""
    came = {REACHED[event.kind]: event.at for event in events if event.kind in REACHED}
    worst: dict[JobPhase, float] = {}
    for each in said:
        if each.outlook is not None and each.at < came[each.outlook.milestone]:
            error_s = abs((each.outlook.at - came[each.outlook.milestone]).total_seconds())
            worst[each.phase] = max(worst.get(each.phase, 0.0), error_s)
    return worst


def test_after_one_job_every_phase_of_the_next_is_foretold_within_a_second() -> None:
    async def scenario(scene: Scene) -> None:
        await scene.carried_out(JobType.CHARGE, 20.0)
        said = _listening(scene)
        job = await scene.carried_out(JobType.CHARGE, 60.0)
        worst = _errors_s(said, await scene.events(job))
        assert set(worst) == set(JobPhase) - {JobPhase.PLUGGED}
        assert max(worst.values()) < 1.0

    on_knowing_scene(scenario, settings=WRONG)


def test_what_was_learnt_survives_a_restart(tmp_path: Path) -> None:
    async def first(scene: Scene) -> None:
        await scene.carried_out(JobType.CHARGE, 20.0)

    async def second(scene: Scene) -> None:
        said = _listening(scene)
        job = await scene.carried_out(JobType.PLUG_IN)
        worst = _errors_s(said, await scene.events(job))
        assert set(worst) >= {JobPhase.ALIGNING, JobPhase.INSERTING}
        assert max(worst.values()) < 1.0

    on_knowing_scene(first, folder=tmp_path, settings=WRONG)
    on_knowing_scene(second, folder=tmp_path, settings=WRONG)


def test_an_interrupted_job_is_foretold_again_once_it_goes_on(tmp_path: Path) -> None:
    async def first(scene: Scene) -> Job:
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.ALIGNING)
        await scene.until_moving()
        return job  # the scene ends here, the job does not

    interrupted = on_knowing_scene(first, seed=4, folder=tmp_path)

    async def second(scene: Scene) -> None:
        said = _listening(scene)
        job = await scene.ended(interrupted)
        assert job.state is JobState.SUCCEEDED
        worst = _errors_s(said, await scene.events(job))
        assert set(worst) >= {JobPhase.PREFLIGHT, JobPhase.ALIGNING, JobPhase.INSERTING}
        assert max(worst.values()) < 2.0  # as drawn, and with a homing

    on_knowing_scene(second, seed=4, folder=tmp_path, parked=False)


def test_a_pause_has_no_end_and_a_cancelled_job_leads_home() -> None:
    async def scenario(scene: Scene) -> None:
        runner, outlook = scene.services.runner, scene.services.outlook
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.ALIGNING)
        await scene.until_moving()
        await runner.pause(job.id)
        await scene.until(lambda: runner.newest is not None and runner.newest.paused)
        assert outlook.now() is None
        await scene.later(30.0)
        await runner.resume(job.id)
        await scene.until_moving()
        now = outlook.now()
        assert now is not None
        assert now.milestone is Milestone.PLUGGED
        said = _listening(scene)
        await runner.cancel(job.id)
        ended = await scene.ended(job)
        assert ended.state is JobState.CANCELLED
        assert outlook.now() is None
        assert {each.outlook.milestone for each in said if each.outlook} == {Milestone.UNPLUGGED}

    on_knowing_scene(scenario)


def test_a_waiting_job_changes_nothing_of_what_is_said_of_the_running_one() -> None:
    async def scenario(scene: Scene) -> None:
        runner, outlook = scene.services.runner, scene.services.outlook
        await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.ALIGNING)
        waiting = await scene.start(JobType.UNPLUG)
        await runner.pause(waiting.id)
        now = outlook.now()
        assert now is not None
        assert now.milestone is Milestone.PLUGGED
        await runner.cancel(waiting.id)
        await runner.wait()

    on_knowing_scene(scenario)


def test_a_long_charge_is_sent_again_only_when_it_has_moved() -> None:
    async def scenario(scene: Scene) -> None:
        sent: list[dict[str, str] | None] = []

        async def watch() -> None:
            async for raw in scene.services.live.watch():
                message = json.loads(raw)
                section = message.get("live") or message["changes"]
                if "outlook" in section:
                    sent.append(section["outlook"])

        job = await scene.start(JobType.CHARGE, 7360.0 / 2)
        await scene.until_phase(JobPhase.CHARGING)
        watching = asyncio.create_task(watch())
        await scene.later(150.0)
        watching.cancel()
        await asyncio.wait([watching])
        told = [each for each in sent if each is not None]
        assert 1 <= len(told) <= 3
        now = scene.services.outlook.now()
        assert now is not None
        assert now.milestone is Milestone.CHARGED
        left_s = (now.at - scene.services.calendar.now()).total_seconds()
        assert left_s == pytest.approx(1800.0 - 150.0, rel=0.03)
        await scene.services.runner.finish(job.id)
        await scene.ended(job)

    on_knowing_scene(scenario)
