"""Pull the plug out along the insertion axis, watching force and station."""

from __future__ import annotations

from server.jobs.context import JobContext
from server.jobs.model import JobPhase
from server.jobs.plugging.pulling import pull_out


async def run(job: JobContext) -> None:
    """Pull the plug out, or stop at the first sign that it must not be.

    Raises:
        StillLockedError: it takes more than the allowed force.
        StillUnderLoadError: current flows; the motion was stopped.
        StationUnsafeError: the station went silent; the motion was stopped.
    """
    await job.journal.begin(JobPhase.WITHDRAWING, "Pulling the plug out.")
    async with job.supervisor.load.watching():
        curve = await pull_out(job)
    await job.journal.note(
        "withdrawn", "The plug is out.", max_pull_n=round(curve.largest_pull_n, 1)
    )
