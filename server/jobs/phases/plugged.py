"""The plug is in: give the station back, and see whether it finds the car."""

from __future__ import annotations

import asyncio

from drivers.station import PilotState, StationDriver, StationError
from server.control.errors import StationUnsafeError
from server.errors import PlugPilotError
from server.jobs.context import JobContext
from server.jobs.errors import NotConnectedError
from server.jobs.model import JobPhase
from server.jobs.plugging.power_off import end_hold

CONTACT_TIMEOUT_S = 5.0
POLL_S = 0.2
CONNECTED = {PilotState.B, PilotState.C, PilotState.D}


async def run(job: JobContext) -> None:
    """End the hold that kept the power off while the plug went in; wait for a connected car.

    Raises:
        NotConnectedError: the control pilot shows no car.
        StationUnsafeError: the station does not answer, or reports a fault.
    """
    await job.journal.begin(JobPhase.PLUGGED, "The plug is in. Asking the charging station.")
    loop = asyncio.get_running_loop()
    deadline_s = loop.time() + CONTACT_TIMEOUT_S
    held = True
    while True:
        against: PlugPilotError | None
        try:
            if held:
                await end_hold(job.station)
                held = False
            against = await _what_it_sees(job.station)
        except StationUnsafeError as error:
            against = error
        if against is None:
            await job.journal.note("connected", "The charging station sees the car.")
            return
        if loop.time() > deadline_s:
            raise against
        await asyncio.sleep(POLL_S)


async def _what_it_sees(station: StationDriver) -> PlugPilotError | None:
    """What speaks against a connected car, or None."""
    try:
        pilot = (await station.snapshot()).pilot
    except StationError as error:
        return StationUnsafeError(str(error))
    if pilot in CONNECTED:
        return None
    if pilot in {PilotState.E, PilotState.F}:
        return StationUnsafeError(
            f"The charging station reports a fault (state {pilot.value}).", pilot=pilot.value
        )
    return NotConnectedError(
        f"The plug is in, but after {CONTACT_TIMEOUT_S:.0f} s the station is still in "
        f"state {pilot.value}.",
        pilot=pilot.value,
    )
