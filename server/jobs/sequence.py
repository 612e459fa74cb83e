"""In which order the phases of each kind of job run, and how to get back from anywhere."""

from __future__ import annotations

import logging

from server.control.errors import (
    ControlLostError,
    EmergencyStoppedError,
    RobotFaultError,
    RobotOfflineError,
    RobotStoppedError,
)
from server.control.model import PlugState
from server.errors import InternalError, PlugPilotError
from server.jobs.context import JobContext
from server.jobs.errors import StillLockedError, StillUnderLoadError
from server.jobs.model import JobType
from server.jobs.phases import (
    aligning,
    charging,
    inserting,
    locating,
    parking,
    plugged,
    preflight,
    releasing,
    withdrawing,
)

_log = logging.getLogger(__name__)

STAY = (
    RobotStoppedError,
    EmergencyStoppedError,
    RobotFaultError,
    RobotOfflineError,
    ControlLostError,
    StillLockedError,
    StillUnderLoadError,
    InternalError,
)
"""After these the robot stays where it is: a person has stopped it, or must look first."""


async def plug_in(job: JobContext) -> None:
    """From the parking place into the socket. May be cancelled at any moment."""
    await preflight.run(job)
    await locating.run(job)
    await aligning.run(job)
    await inserting.run(job)
    await plugged.run(job)


async def unplug(job: JobContext) -> None:
    """From the socket to the parking place. Runs to its end once the plug moves."""
    await releasing.run(job)
    await withdrawing.run(job)
    await parking.run(job)


async def carry_out(job: JobContext) -> None:
    """Everything that a job of its type does when nothing goes wrong."""
    match job.journal.job.type:
        case JobType.PLUG_IN:
            await plug_in(job)
        case JobType.CHARGE:
            await plug_in(job)
            await charging.run(job)
            await unplug(job)
        case JobType.UNPLUG:
            await preflight.switch_on(job)
            await unplug(job)


async def retreat(job: JobContext, cause: PlugPilotError | None) -> None:
    """Bring plug and robot back to safety after a cancellation or an error.

    What goes wrong on the way back is written into the journal; the cause stays the job's error.
    """
    if isinstance(cause, STAY):
        return
    try:
        if job.supervisor.plug.state is PlugState.INSERTED:
            await unplug(job)
        elif (
            job.supervisor.plug.state is PlugState.FREE and job.supervisor.telemetry.require().homed
        ):
            await parking.run(job)
    except PlugPilotError as error:
        _log.warning("the robot could not go back: %s", error)
        await job.journal.note(
            "retreat_failed", f"{error.title}: {error.detail} {error.remedy}", code=error.code
        )
