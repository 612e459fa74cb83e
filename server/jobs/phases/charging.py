"""Let the car charge until it is full, has its energy, it is time, or somebody ends it."""

from __future__ import annotations

import asyncio
import contextlib
from datetime import timedelta

from drivers.station import StationError, StationSnapshot
from server.control.errors import StationUnsafeError
from server.jobs.context import JobContext
from server.jobs.errors import CarGoneError
from server.jobs.model import JobPhase
from server.jobs.plugging.charging_watch import ChargingWatch
from server.jobs.plugging.power_off import end_hold, forbid_power

POLL_S = 1.0
CAR_DECIDES_S = 30.0
"""A car that may have power and draws nothing for this long, after it did or from the start, wants
no more."""
STANDBY_W = 50.0
"""A charging car draws 1.4 kW or more (6 A); what is below is a meter's noise or a heater."""
KEEP_PERIOD_S = 60.0
"""How often the energy so far is kept: what a restart may take away of it."""

ENDED_BY_HAND = "Somebody ended the charging."


async def run(job: JobContext) -> None:
    """Charge, or go on charging; returns when the charging should end.

    Raises:
        StationUnsafeError: the station reports a fault, or has been silent for too long.
        CarGoneError: the station lost the car, or the plug has moved; the power is off.
    """
    await job.journal.begin(JobPhase.CHARGING, "Charging.")
    if job.finish.is_set():
        await job.journal.note("charging_done", ENDED_BY_HAND)
        return
    try:
        first = await job.station.snapshot()
        if first.held:
            # Ours, from a pause or from a withdrawal that a restart has ended.
            await end_hold(job.station)
        await job.station.start()
    except StationError as error:
        raise StationUnsafeError(str(error)) from error
    energy_before_wh = await _energy_before_wh(job, first)
    await _begin_cost(job, first.session_energy_wh - energy_before_wh)
    try:
        reason = await _until_done(job, energy_before_wh)
    except CarGoneError:
        await forbid_power(job.station)
        raise
    await job.journal.note("charging_done", reason)


async def suspend(job: JobContext) -> None:
    """Take the power off for the length of a pause; ``run`` gives it back.

    Raises:
        StationUnsafeError: the station does not answer.
    """
    await forbid_power(job.station)
    if job.cost is not None and job.energy_wh is not None:
        # The price of the time that passes without power does not count.
        job.cost.read(job.energy_wh, job.calendar.now())
        await job.journal.charged(job.energy_wh, **job.cost_so_far)


async def _energy_before_wh(job: JobContext, first: StationSnapshot) -> float:
    """What the station's counter showed when this job's charging began.

    After a restart it is in the journal; a station that has begun to count anew since, as after a
    power cut of its own, has given what was kept last.
    """
    known_wh = (await job.journal.history()).energy_before_wh
    if known_wh is not None and first.session_energy_wh >= known_wh:
        return known_wh
    before_wh = first.session_energy_wh - (job.journal.job.result.energy_wh or 0.0)
    await job.journal.note(
        "charging_started", "Power is allowed.", energy_before_wh=round(before_wh, 3)
    )
    return before_wh


async def _begin_cost(job: JobContext, energy_wh: float) -> None:
    """Count the cost from what is kept, and what has flowed since while nobody looked."""
    job.count_cost()
    if job.cost is not None:
        job.cost.read(energy_wh, job.calendar.now())
        await job.journal.charged(energy_wh, **job.cost_so_far)


async def _until_done(job: JobContext, energy_before_wh: float) -> str:
    loop = asyncio.get_running_loop()
    hungry_s = kept_s = loop.time()
    watch = ChargingWatch(job, heard_s=loop.time())
    while True:
        if await _finish_wanted(job):
            return ENDED_BY_HAND
        if _must_be_unplugged(job):
            return "It is time to unplug."
        try:
            snapshot = await job.station.snapshot()
        except StationError as error:
            await watch.check(None, loop.time(), str(error))
            continue
        heard_s = loop.time()
        await watch.check(snapshot, heard_s)
        if snapshot.power_w > STANDBY_W or _is_kept_from_charging(job, snapshot):
            hungry_s = heard_s
        energy_wh = snapshot.session_energy_wh - energy_before_wh
        job.energy_wh = energy_wh
        if job.cost is not None:
            job.cost.read(energy_wh, job.calendar.now())
        if heard_s - kept_s > KEEP_PERIOD_S:
            kept_s = heard_s
            await job.journal.charged(energy_wh, **job.cost_so_far)
        target_wh = job.journal.job.target_energy_wh
        if target_wh is not None and energy_wh >= target_wh:
            return f"The car has got its {target_wh / 1000:.1f} kWh."
        if heard_s - hungry_s > CAR_DECIDES_S:
            return "The car takes no more energy."


def _must_be_unplugged(job: JobContext) -> bool:
    """Asked anew each time, so that it does not matter if the clock has been set meanwhile."""
    unplug_by = job.journal.job.unplug_by
    if unplug_by is None:
        return False
    lead = timedelta(seconds=job.settings.jobs.unplug_lead_s)
    return job.calendar.now() >= unplug_by - lead


def _is_kept_from_charging(job: JobContext, snapshot: StationSnapshot) -> bool:
    """An energy manager waits for the sun: that the car draws nothing is not the car's wish."""
    return job.station.capabilities.switches and not snapshot.enabled


async def _finish_wanted(job: JobContext) -> bool:
    """Wait one polling period, or less when somebody wants the charging to end."""
    with contextlib.suppress(TimeoutError):
        async with asyncio.timeout(POLL_S):
            await job.finish.wait()
    return job.finish.is_set()
