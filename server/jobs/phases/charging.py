"""Let the car charge until it is full, has its energy, or somebody ends it."""

from __future__ import annotations

import asyncio
import contextlib

from drivers.station import PilotState, StationError, StationSnapshot
from server.jobs.context import JobContext
from server.jobs.errors import StationUnsafeError
from server.jobs.model import JobPhase

POLL_S = 1.0
CAR_DECIDES_S = 30.0
"""A car that draws nothing for this long, after it did or from the start, wants no more."""
STANDBY_W = 50.0
"""A charging car draws 1.4 kW or more (6 A); what is below is a meter's noise or a heater."""
SILENCE_LIMIT_S = 60.0


async def run(job: JobContext) -> None:
    """Charge; returns when the charging should end.

    Raises:
        StationUnsafeError: the station reports a fault, or has been silent for a minute.
    """
    await job.journal.begin(JobPhase.CHARGING, "Charging.")
    try:
        await job.station.start()
        first = await job.station.snapshot()
    except StationError as error:
        raise StationUnsafeError(str(error)) from error
    energy_before_wh = first.session_energy_wh
    reason = await _until_done(job, energy_before_wh)
    await job.journal.note("charging_done", reason)


async def _until_done(job: JobContext, energy_before_wh: float) -> str:
    loop = asyncio.get_running_loop()
    heard_s = drawing_s = loop.time()
    while True:
        if await _finish_wanted(job):
            return "Somebody ended the charging."
        try:
            snapshot = await job.station.snapshot()
        except StationError as error:
            if loop.time() - heard_s > SILENCE_LIMIT_S:
                raise StationUnsafeError(
                    f"The charging station has been silent for {SILENCE_LIMIT_S:.0f} s: {error}"
                ) from error
            continue
        heard_s = loop.time()
        _refuse_fault(snapshot)
        if snapshot.power_w > STANDBY_W:
            drawing_s = heard_s
        energy_wh = snapshot.session_energy_wh - energy_before_wh
        job.energy_wh = energy_wh
        target_wh = job.journal.job.target_energy_wh
        if target_wh is not None and energy_wh >= target_wh:
            return f"The car has got its {target_wh / 1000:.1f} kWh."
        if heard_s - drawing_s > CAR_DECIDES_S:
            return "The car takes no more energy."


async def _finish_wanted(job: JobContext) -> bool:
    """Wait one polling period, or less when somebody wants the charging to end."""
    with contextlib.suppress(TimeoutError):
        async with asyncio.timeout(POLL_S):
            await job.finish.wait()
    return job.finish.is_set()


def _refuse_fault(snapshot: StationSnapshot) -> None:
    if snapshot.pilot in {PilotState.E, PilotState.F}:
        raise StationUnsafeError(
            f"The charging station reports a fault (state {snapshot.pilot.value}).",
            pilot=snapshot.pilot.value,
        )
