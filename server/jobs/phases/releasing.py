"""Make sure that no current flows and that the connector lets go.

The order matters: first forbid power, then a hold that outranks whoever might allow it again,
then two fresh samples without load, then unlock. A stopped station restarts by itself more often
than one would think.
"""

from __future__ import annotations

import asyncio

from drivers.station import (
    PilotState,
    StationCapabilities,
    StationDriver,
    StationError,
    StationSnapshot,
)
from server.jobs.context import JobContext
from server.jobs.errors import JobError, StationUnsafeError, StillUnderLoadError
from server.jobs.model import JobPhase

SAMPLES_NEEDED = 2
SAMPLE_S = 0.25
FRESH_S = 1.0
"""An older reading says nothing about now."""
TIMEOUT_S = 30.0


async def run(job: JobContext) -> None:
    """Take the load off and unlock the connector.

    Raises:
        StillUnderLoadError: the current does not stop.
        StationUnsafeError: the station does not answer.
    """
    await job.journal.begin(JobPhase.RELEASING, "Ending the charging and unlocking the plug.")
    station = job.station
    try:
        energy_wh = (await station.snapshot()).session_energy_wh
        if station.capabilities.switches:
            await station.stop()
        if station.capabilities.holds:
            await station.hold()
        await _wait_for_no_load(station)
        if station.capabilities.unlocks:
            await station.unlock()
    except StationError as error:
        raise StationUnsafeError(str(error)) from error
    await job.journal.measured(
        "released",
        "No current flows, and the plug is unlocked.",
        energy_wh=round(max(energy_wh, job.energy_wh or 0.0), 1),
    )


async def end_hold(station: StationDriver) -> None:
    """Give the station back to whoever controls it otherwise.

    Raises:
        StationUnsafeError: the station does not answer.
    """
    if station.capabilities.holds:
        try:
            await station.release()
        except StationError as error:
            raise StationUnsafeError(
                f"The hold on the station could not be released: {error}"
            ) from error


def why_not_safe(
    snapshot: StationSnapshot, capabilities: StationCapabilities, now_s: float
) -> JobError | None:
    """What a reading has against pulling the plug now; None proves that it is safe."""
    age_s = now_s - snapshot.sampled_at_s
    if age_s > FRESH_S:
        return StationUnsafeError(
            f"The newest reading of the charging station is {age_s:.1f} s old.",
            age_s=round(age_s, 1),
        )
    # Enabled while it sees the car, a station may give power at any moment.
    is_ready = capabilities.switches and snapshot.enabled and snapshot.pilot is not PilotState.A
    if snapshot.carries_load or is_ready:
        current_a = round(max(snapshot.currents_a), 2)
        return StillUnderLoadError(
            f"The charging station gives {current_a:.1f} A or is about to "
            f"(state {snapshot.pilot.value}).",
            current_a=current_a,
            pilot=snapshot.pilot.value,
        )
    return None


async def _wait_for_no_load(station: StationDriver) -> None:
    loop = asyncio.get_running_loop()
    deadline_s = loop.time() + TIMEOUT_S
    safe_in_a_row, last_sample_s = 0, -1.0
    while safe_in_a_row < SAMPLES_NEEDED:
        snapshot = await station.snapshot()
        problem = why_not_safe(snapshot, station.capabilities, loop.time())
        if problem is not None:
            safe_in_a_row = 0
        elif snapshot.sampled_at_s > last_sample_s:
            safe_in_a_row += 1
        last_sample_s = max(snapshot.sampled_at_s, last_sample_s)
        if problem is not None and loop.time() > deadline_s:
            raise problem
        await asyncio.sleep(SAMPLE_S)
