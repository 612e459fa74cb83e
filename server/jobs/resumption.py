"""Takes a job up again after a restart or a pause."""

from __future__ import annotations

import asyncio

from server.jobs import sequence
from server.jobs.context import JobContext
from server.jobs.recovery import IN_WORDS, OWN_SILENCE, Evidence, Way, decide
from server.schema.jobs import NeedsPerson

ROBOT_COMES_S = 15.0
"""A board takes seconds to start. After this a person is told that the job waits for it."""

LOOK_S = 0.25

ROBOT_OFFLINE = NeedsPerson(
    code="robot_offline",
    sentence="The job goes on by itself as soon as the motion board answers. Check that it has "
    "power and that its USB cable is plugged in.",
    choices=[],
)


async def after_restart(job: JobContext) -> None:
    """Go on with a job that a restart has interrupted.

    Raises:
        JobInterruption: it cannot go on by itself.
        PlugPilotError: as in ``sequence.carry_out``.
    """
    job.restarted = True
    await _until_robot_answers(job)
    job.start = job.supervisor.telemetry.require().commanded.position
    await _go_on(job, after_restart=True)


async def after_pause(job: JobContext) -> None:
    """Go on with a job that a person resumes.

    Raises:
        JobInterruption: it cannot go on by itself.
        PlugPilotError: as in ``sequence.carry_out``.
    """
    await _until_robot_answers(job)
    await _go_on(job, after_restart=False)


async def _go_on(job: JobContext, *, after_restart: bool) -> None:
    journal, supervisor = job.journal, job.supervisor
    interrupted_in = journal.job.phase
    seen = Evidence(
        job=journal.job,
        history=await journal.history(),
        after_restart=after_restart,
        outage=job.calendar.now() - journal.job.updated_at,
        plug=supervisor.plug.state,
        fault=supervisor.fault,
    )
    way = decide(seen, job.settings.jobs)
    why = "PlugPilot was restarted" if after_restart else "The job goes on"
    await journal.resumed(
        interrupted_in,
        f"{why} in the phase {interrupted_in.value}. {IN_WORDS[way]}",
        after_restart=after_restart,
    )
    if after_restart:
        await supervisor.release_fault(job.lease, *OWN_SILENCE)
    await _carry_on(job, way)


async def _carry_on(job: JobContext, way: Way) -> None:
    match way:
        case Way.PLUG_IN:
            await sequence.carry_out(job)
        case Way.PULL_OUT_FIRST:
            await sequence.pull_out(job)
            await sequence.carry_out(job)
        case Way.STAY_IN:
            await sequence.stay_in(job)
        case Way.UNPLUG:
            await sequence.unplug(job)
        case Way.PARK:
            await sequence.park(job)
        case Way.NOTHING:
            await sequence.end_hold(job)


async def _until_robot_answers(job: JobContext) -> None:
    loop = asyncio.get_running_loop()
    ask_at_s = loop.time() + ROBOT_COMES_S
    asked = False
    while job.supervisor.telemetry.latest is None:
        if not asked and loop.time() > ask_at_s:
            asked = True
            await job.journal.ask(ROBOT_OFFLINE)
        await asyncio.sleep(LOOK_S)
    if asked:
        await job.journal.answered("The motion board answers again.")
