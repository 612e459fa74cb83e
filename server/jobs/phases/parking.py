"""Go to the parking place: the plug back first, then sideways."""

from __future__ import annotations

from drivers.station import StationError
from server.jobs.context import JobContext
from server.jobs.errors import StationUnsafeError
from server.jobs.model import JobPhase
from twin.joints import JointPosition, TipPosition
from twin.kinematics import gamma


async def run(job: JobContext) -> None:
    """Park, and give the station back to whoever controls it otherwise."""
    await job.journal.begin(JobPhase.PARKING, "Going back to the parking place.")
    await go(job)
    if job.station.capabilities.holds:
        try:
            await job.station.release()
        except StationError as error:
            raise StationUnsafeError(
                f"The hold on the station could not be released: {error}"
            ) from error


async def go(job: JobContext) -> None:
    """Retract the plug, then move sideways to the parking place."""
    supervisor = job.supervisor
    target = parking_joints(job)
    at = supervisor.telemetry.require().commanded.position
    if at.rho3_mm > target.rho3_mm:
        await supervisor.move_joints(job.lease, at._replace(rho3_mm=target.rho3_mm))
    await supervisor.move_joints(job.lease, target)
    await supervisor.plug.is_parked()


def parking_joints(job: JobContext) -> JointPosition:
    """Joints of the parking place."""
    geometry, park = job.supervisor.geometry, job.settings.park
    dy_mm, z_mm = gamma.tip_offset(geometry, park.rho3_mm)
    return gamma.inverse(geometry, TipPosition(park.x_mm, park.y_mm + dy_mm, z_mm))
