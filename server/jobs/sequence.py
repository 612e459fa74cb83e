"""In which order the phases of each kind of job run, and how to get back from anywhere."""

from __future__ import annotations

from drivers.station import StationError
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
from server.jobs.errors import (
    JobCancelledError,
    StationUnsafeError,
    StillLockedError,
    StillUnderLoadError,
)
from server.jobs.model import JobPhase, JobType
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
from server.schema.jobs import Job
from server.storage.errors import StorageError

STOPS = (RobotStoppedError, EmergencyStoppedError)

STAY = (
    *STOPS,
    RobotFaultError,
    RobotOfflineError,
    ControlLostError,
    StillLockedError,
    StillUnderLoadError,
    StorageError,
    InternalError,
)
"""After these the robot stays where it is: a person has stopped it, or must look first."""

WAY_BACK = {JobPhase.RELEASING, JobPhase.WITHDRAWING, JobPhase.PARKING}
"""What goes wrong here is not tried again: a person must look first."""


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
            await preflight.make_ready_to_unplug(job)
            await unplug(job)


def may_be_cancelled(job: Job) -> bool:
    """Whether cancelling a running job changes anything: it is not on its way back already.

    Unplugging can be given up until the plug moves.
    """
    if job.type is JobType.UNPLUG:
        return job.phase in {JobPhase.PREFLIGHT, JobPhase.RELEASING}
    return job.phase not in WAY_BACK


async def retreat(job: JobContext, cause: PlugPilotError) -> None:
    """Bring plug and robot back to safety after a cancellation or an error.

    Raises:
        PlugPilotError: what went wrong on the way back; the robot stays where it is.
    """
    if isinstance(cause, STOPS):
        await _power_off(job)
    if isinstance(cause, STAY):
        return
    if job.journal.job.type is JobType.UNPLUG:
        if isinstance(cause, JobCancelledError):
            await releasing.end_hold(job.station)
        return
    if job.journal.job.phase in WAY_BACK:
        return
    plug = job.supervisor.plug.state
    if plug is PlugState.INSERTED:
        await unplug(job)
    elif plug is PlugState.FREE and job.supervisor.telemetry.require().homed:
        await parking.run(job)


async def _power_off(job: JobContext) -> None:
    """Somebody pressed a stop: the car gets no more power either."""
    if job.supervisor.plug.state is PlugState.INSERTED and job.station.capabilities.switches:
        try:
            await job.station.stop()
        except StationError as error:
            raise StationUnsafeError(f"The power could not be switched off: {error}") from error
