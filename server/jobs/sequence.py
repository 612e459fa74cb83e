"""In which order the phases of each kind of job run, and how to get back from anywhere."""

from __future__ import annotations

from drivers.station import StationError
from server.control.errors import StationUnsafeError
from server.control.model import PlugState
from server.control.plug_guard import HELD
from server.jobs.context import JobContext
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
from server.jobs.plugging import power_off
from server.jobs.recovery import OWN_SILENCE
from server.jobs.turning_back import Return, TurnBack


async def carry_out(job: JobContext) -> None:
    """Everything that a job of its type does when nothing goes wrong."""
    match job.journal.job.type:
        case JobType.PLUG_IN | JobType.CHARGE:
            await _plug_in(job)
            await stay_in(job)
        case JobType.UNPLUG:
            await preflight.make_ready_to_unplug(job)
            await unplug(job)


async def _plug_in(job: JobContext) -> None:
    """From the parking place into the socket. May be interrupted at any moment."""
    await preflight.run(job)
    await locating.run(job)
    await aligning.run(job)
    await inserting.run(job)


async def stay_in(job: JobContext) -> None:
    """With the plug seated: what is left of a job that plugs in."""
    await plugged.run(job)
    if job.journal.job.type is JobType.CHARGE:
        await charging.run(job)
        await unplug(job)


async def unplug(job: JobContext) -> None:
    """From the socket to the parking place. Runs to its end once the plug moves."""
    await pull_out(job)
    await parking.run(job)


async def pull_out(job: JobContext) -> None:
    """From the socket to a free plug before it."""
    await _drives_on(job)
    await releasing.run(job)
    await withdrawing.run(job)


async def park(job: JobContext) -> None:
    """From anywhere with a free plug to the parking place."""
    await _drives_on(job)
    if not job.supervisor.telemetry.require().homed:
        await job.journal.note("homing", "Finding the zero of each axis.")
        await job.supervisor.home(job.lease)
    await parking.run(job)


async def end_hold(job: JobContext) -> None:
    """In the parking place: give the station back to whoever controls it otherwise."""
    await power_off.end_hold(job.station)


async def go_back(job: JobContext, turn: TurnBack) -> None:
    """Bring plug and robot back to safety after a cancellation or an error.

    Raises:
        PlugPilotError: what went wrong on the way back; the robot stays where it is.
    """
    match turn.how:
        case Return.POWER_OFF:
            await _power_off(job)
        case Return.END_HOLD if job.supervisor.plug.state in HELD:
            await power_off.end_hold(job.station)
        case Return.COME_BACK | Return.END_HOLD:
            await _come_back(job)
        case Return.STAY:
            pass


async def _come_back(job: JobContext) -> None:
    plug = job.supervisor.plug.state
    if job.restarted:
        await job.supervisor.release_fault(job.lease, *OWN_SILENCE)
    if plug is PlugState.INSERTED or (plug in HELD and job.restarted):
        await unplug(job)
    elif plug is PlugState.FREE and (job.supervisor.telemetry.require().homed or job.restarted):
        await park(job)


async def _drives_on(job: JobContext) -> None:
    """They are off after a restart, and may have been switched off while the car charged."""
    if not job.supervisor.telemetry.require().enabled:
        await job.journal.note("enabling", "Switching the drives on.")
        await job.supervisor.enable(job.lease)


async def _power_off(job: JobContext) -> None:
    """Somebody pressed a stop: the car gets no more power either."""
    if job.supervisor.plug.state in HELD and job.station.capabilities.switches:
        try:
            await job.station.stop()
        except StationError as error:
            raise StationUnsafeError(f"The power could not be switched off: {error}") from error
