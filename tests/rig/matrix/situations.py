"""What may be going on when something goes wrong."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import dataclass

from server.errors import PlugPilotError
from server.jobs.model import JobPhase, JobState, JobType
from tests.rig.charger import Charger, do_job
from tests.support.eventually import eventually

WITHIN_S = 60.0
FAST_MM_S = 20.0
SLOW_MM_S = 3.0
SOME_MM = 8.0
HALF_OUT_MM = 25.0

Activity = asyncio.Task[str]
"""Ends with "done", or with the code of the error that ended it."""


@dataclass(frozen=True, slots=True)
class Situation:
    """Something that goes on.

    Attributes:
        name: Of it.
        parked: Begins with a homed robot in its parking place.
        enter: Brings it about; returns what goes on, or None at rest.
    """

    name: str
    parked: bool
    enter: Callable[[Charger], Awaitable[Activity | None]]


async def _home(charger: Charger) -> str:
    supervisor = charger.services.supervisor
    try:
        async with supervisor.control("homing", "A person") as lease:
            await supervisor.enable(lease)
            await supervisor.home(lease)
    except PlugPilotError as error:
        return error.code
    return "done"


async def _job(charger: Charger, kind: JobType) -> str:
    job = await do_job(charger.services, kind)
    if job.state is JobState.SUCCEEDED:
        return "done"
    return job.error.code if job.error is not None else job.state.value


def _lateral_mm_s(charger: Charger) -> float:
    state = charger.services.supervisor.telemetry.latest
    if state is None:
        return 0.0
    velocity = state.commanded.velocity
    return max(abs(velocity.rho1_mm_s), abs(velocity.rho2_mm_s))


def _in_phase(charger: Charger, phase: JobPhase) -> bool:
    job = charger.services.runner.newest
    return job is not None and job.phase is phase


def _depth_mm(charger: Charger) -> float:
    return charger.garage.world.truth().insertion_depth_mm


async def _until(activity: Activity, condition: Callable[[], bool]) -> Activity:
    await eventually(lambda: activity.done() or condition(), within_s=WITHIN_S)
    assert not activity.done(), f"it ended before: {activity.result()}"
    return activity


async def at_rest(charger: Charger) -> None:
    """Drives on, not homed."""
    supervisor = charger.services.supervisor
    async with supervisor.control("homing", "A person") as lease:
        await supervisor.enable(lease)


async def homing(charger: Charger) -> Activity:
    """A carriage seeks its switch."""
    activity = asyncio.create_task(_home(charger))
    return await _until(activity, lambda: _lateral_mm_s(charger) > FAST_MM_S)


async def moving(charger: Charger) -> Activity:
    """A job moves the plug in front of the socket."""
    activity = asyncio.create_task(_job(charger, JobType.PLUG_IN))
    return await _until(activity, lambda: _lateral_mm_s(charger) > SLOW_MM_S)


async def inserting(charger: Charger) -> Activity:
    """The plug is on its way in."""
    activity = asyncio.create_task(_job(charger, JobType.PLUG_IN))
    return await _until(
        activity,
        lambda: _in_phase(charger, JobPhase.INSERTING) and _depth_mm(charger) > SOME_MM,
    )


async def plugged_in(charger: Charger) -> None:
    """The plug rests in the socket."""
    assert await _job(charger, JobType.PLUG_IN) == "done"


async def withdrawing(charger: Charger) -> Activity:
    """The plug is on its way out."""
    await plugged_in(charger)
    activity = asyncio.create_task(_job(charger, JobType.UNPLUG))
    return await _until(
        activity,
        lambda: _in_phase(charger, JobPhase.WITHDRAWING) and _depth_mm(charger) < HALF_OUT_MM,
    )


SITUATIONS = (
    Situation("at rest, not homed", parked=False, enter=at_rest),
    Situation("homing", parked=False, enter=homing),
    Situation("moving laterally", parked=True, enter=moving),
    Situation("inserting", parked=True, enter=inserting),
    Situation("plugged in", parked=True, enter=plugged_in),
    Situation("withdrawing", parked=True, enter=withdrawing),
)
