"""Before anything moves: is everything there, and does the robot know where it is?"""

from __future__ import annotations

from drivers.station import PilotState, StationError, StationSnapshot
from server.control.errors import StationUnsafeError
from server.control.model import PlugState
from server.jobs.context import JobContext
from server.jobs.model import JobPhase
from server.jobs.phases import parking


async def run(job: JobContext) -> None:
    """Check station and robot, switch the drives on, home when needed, go to the parking place.

    Raises:
        StationUnsafeError: the station is out of order, or sees a car although none is plugged in.
        ControlError: the robot cannot be made ready.
    """
    await job.journal.begin(JobPhase.PREFLIGHT, "Checking the robot and the charging station.")
    await _check_station(job)
    await _switch_on(job)
    await _home(job)
    if job.supervisor.plug.state is not PlugState.PARKED:
        await parking.go(job)


async def make_ready_to_unplug(job: JobContext) -> None:
    """Switch the drives on; where the robot is shows in how it withdraws."""
    await job.journal.begin(JobPhase.PREFLIGHT, "Checking the robot.")
    await _switch_on(job)


async def _switch_on(job: JobContext) -> None:
    if not job.supervisor.telemetry.require().enabled:
        await job.journal.note("enabling", "Switching the drives on.")
        await job.supervisor.enable(job.lease)


async def _home(job: JobContext) -> None:
    if not job.supervisor.telemetry.require().homed:
        await job.journal.note("homing", "Finding the zero of each axis.")
        await job.supervisor.home(job.lease)


async def _check_station(job: JobContext) -> None:
    """Look only: whoever charges at this station meanwhile is not disturbed."""
    capabilities = job.station.capabilities
    if not capabilities.fresh:
        raise StationUnsafeError(
            "The readings of this charging station are too old: nobody could tell later whether "
            "the plug may be pulled. Configure the station itself as station.driver and its "
            "energy manager as station.manager."
        )
    if not capabilities.senses_car:
        raise StationUnsafeError(
            "This charging station does not sense whether a car is connected. Wire a contact that "
            "does, and name it in the settings of the station."
        )
    try:
        _refuse_unsafe(await job.station.snapshot())
    except StationError as error:
        raise StationUnsafeError(str(error)) from error


def _refuse_unsafe(snapshot: StationSnapshot) -> None:
    if snapshot.pilot in {PilotState.E, PilotState.F}:
        raise StationUnsafeError(
            f"The charging station is out of order (state {snapshot.pilot.value}).",
            pilot=snapshot.pilot.value,
        )
    if snapshot.pilot is not PilotState.A or snapshot.carries_load:
        raise StationUnsafeError(
            "The charging station says that a car is connected, but the plug is not in one.",
            pilot=snapshot.pilot.value,
        )
