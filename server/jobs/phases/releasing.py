"""Make sure that no current flows and that the connector lets go.

The order matters: first forbid power, then a hold that outranks whoever might allow it again,
then two fresh samples without load, then unlock. A stopped station restarts by itself more often
than one would think.
"""

from __future__ import annotations

import asyncio

from drivers.station import StationDriver, StationError, StationSnapshot
from server.jobs.context import JobContext
from server.jobs.errors import StationUnsafeError, StillUnderLoadError
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


async def _wait_for_no_load(station: StationDriver) -> None:
    loop = asyncio.get_running_loop()
    deadline_s = loop.time() + TIMEOUT_S
    safe_in_a_row, last_sample_s = 0, -1.0
    while safe_in_a_row < SAMPLES_NEEDED:
        snapshot = await station.snapshot()
        if snapshot.sampled_at_s > last_sample_s:
            last_sample_s = snapshot.sampled_at_s
            safe_in_a_row = safe_in_a_row + 1 if is_safe(snapshot, loop.time()) else 0
        if loop.time() > deadline_s:
            raise StillUnderLoadError(
                f"After {TIMEOUT_S:.0f} s the station still gives {max(snapshot.currents_a):.1f} A "
                f"(state {snapshot.pilot.value}).",
                current_a=max(snapshot.currents_a),
                pilot=snapshot.pilot.value,
            )
        await asyncio.sleep(SAMPLE_S)


def is_safe(snapshot: StationSnapshot, now_s: float) -> bool:
    """Whether a reading proves that the plug may be pulled now."""
    return now_s - snapshot.sampled_at_s <= FRESH_S and not snapshot.carries_load
