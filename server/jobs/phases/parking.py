"""Go to the parking place: the plug back first, then sideways."""

from __future__ import annotations

from server.jobs.approach import parking_joints
from server.jobs.context import JobContext
from server.jobs.model import JobPhase
from server.jobs.plugging.power_off import end_hold


async def run(job: JobContext) -> None:
    """Park, and give the station back to whoever controls it otherwise."""
    await job.journal.begin(JobPhase.PARKING, "Going back to the parking place.")
    await go(job)
    await end_hold(job.station)


async def go(job: JobContext) -> None:
    """Retract the plug, then move sideways to the parking place."""
    supervisor = job.supervisor
    target = parking_joints(supervisor.geometry, job.settings.park)
    at = supervisor.telemetry.require().commanded.position
    if at.rho3_mm > target.rho3_mm:
        await supervisor.move_joints(job.lease, at._replace(rho3_mm=target.rho3_mm))
    await supervisor.move_from_below(job.lease, target)
    await supervisor.plug.is_parked()
