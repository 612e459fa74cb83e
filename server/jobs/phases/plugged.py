"""The plug is in: does the station see the car?"""

from __future__ import annotations

import asyncio

from drivers.station import PilotState, StationDriver, StationError
from server.jobs.context import JobContext
from server.jobs.errors import JobError, NotConnectedError, StationUnsafeError
from server.jobs.model import JobPhase

CONTACT_TIMEOUT_S = 5.0
POLL_S = 0.2
CONNECTED = {PilotState.B, PilotState.C, PilotState.D}


async def run(job: JobContext) -> None:
    """Wait until the control pilot shows a connected car.

    Raises:
        NotConnectedError: it does not.
        StationUnsafeError: the station does not answer, or reports a fault.
    """
    await job.journal.begin(JobPhase.PLUGGED, "The plug is in. Asking the charging station.")
    loop = asyncio.get_running_loop()
    deadline_s = loop.time() + CONTACT_TIMEOUT_S
    while True:
        seen = await _what_it_sees(job.station)
        if seen is None:
            await job.journal.note("connected", "The charging station sees the car.")
            return
        if loop.time() > deadline_s:
            raise seen
        await asyncio.sleep(POLL_S)


async def _what_it_sees(station: StationDriver) -> JobError | None:
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
