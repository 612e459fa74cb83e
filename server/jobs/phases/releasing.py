"""Make sure that no current flows and that the connector lets go.

The order matters: the energy manager goes off with its mode remembered, then a hold outranks
whoever might allow power again, then two fresh samples without load, then unlock. Withdrawing goes
on watching, and parking gives the station and the manager back.
"""

from __future__ import annotations

from drivers.station import StationError
from server.control.errors import StationUnsafeError
from server.jobs.context import JobContext
from server.jobs.model import JobPhase
from server.jobs.plugging.power_off import forbid_power, unlock


async def run(job: JobContext) -> None:
    """Take the load off and unlock the connector.

    Raises:
        StillUnderLoadError: the current does not stop.
        StationUnsafeError: the station does not answer.
    """
    await job.journal.begin(JobPhase.RELEASING, "Ending the charging and unlocking the plug.")
    try:
        energy_wh = (await job.station.snapshot()).session_energy_wh
    except StationError as error:
        raise StationUnsafeError(str(error)) from error
    await forbid_power(job.station)
    await job.supervisor.load.prove(job.settings.supervision.proof_patience_s)
    await unlock(job.station)
    charged_wh = round(max(energy_wh, job.energy_wh or 0.0), 1)
    if job.cost is None and job.journal.job.result.cost is not None:
        job.count_cost()  # a restart came after the charging
    if job.cost is not None:
        job.cost.read(charged_wh, job.calendar.now())
        await job.journal.charged(charged_wh, **job.cost_so_far)
    await job.journal.measured(
        "released",
        "No current flows, and the plug is unlocked.",
        energy_wh=charged_wh,
    )
