"""Push the plug in along the insertion axis, watching force and depth."""

from __future__ import annotations

import asyncio

from drivers.robot import FaultCode
from server.control.errors import ForceLimitError, RobotFaultError
from server.control.force_watch import ForceWatch
from server.jobs.approach import corridor, lateral_error_mm
from server.jobs.context import JobContext
from server.jobs.errors import InsertionDepthError, InsertionJammedError
from server.jobs.model import JobPhase
from twin.kinematics import gamma
from twin.motion import minimum_time_s, plan_straight_line


async def run(job: JobContext) -> None:
    """Insert to the full depth.

    Raises:
        InsertionJammedError: the force reached its limit before the plug was in.
        RobotFaultError: the board stopped for another reason.
        InsertionDepthError: the plug came to rest at the wrong depth.
    """
    await job.journal.begin(JobPhase.INSERTING, "Pushing the plug in.")
    supervisor, settings = job.supervisor, job.settings.insertion
    geometry, socket = supervisor.geometry, job.require_socket()
    at = supervisor.telemetry.require().commanded.position
    way = corridor(geometry, at, socket, settings)
    axis_error_mm = lateral_error_mm(geometry, at, socket)
    await supervisor.set_force_limit(job.lease, settings.force_limit_n)
    # On disk before the plug can touch the socket.
    await supervisor.plug.about_to_enter(way)
    seated = at._replace(rho3_mm=way.depth_rho3_mm)
    plan = plan_straight_line(geometry, supervisor.limits, at, gamma.forward(geometry, seated))
    forces = ForceWatch(push_limit_n=settings.force_limit_n)
    try:
        await supervisor.follow(job.lease, plan, forces.check)
    except (ForceLimitError, RobotFaultError) as error:
        if not _is_jam(error):
            raise
        depth_mm = supervisor.telemetry.require().measured.position.rho3_mm - way.face_rho3_mm
        raise InsertionJammedError(
            f"{error.detail} The plug was {depth_mm:.1f} mm deep of {settings.depth_mm:.0f} mm.",
            depth_mm=round(depth_mm, 2),
            max_force_n=round(forces.largest_push_n, 1),
        ) from error
    plugged_after_s = asyncio.get_running_loop().time() - job.accepted_at_s
    depth_mm = supervisor.telemetry.require().measured.position.rho3_mm - way.face_rho3_mm
    limit_s = minimum_time_s(supervisor.limits, job.start, at) + minimum_time_s(
        supervisor.limits, at, seated
    )
    await job.journal.measured(
        "seated",
        f"The plug is {depth_mm:.1f} mm deep.",
        insertion_depth_mm=round(depth_mm, 3),
        lateral_error_mm=round(axis_error_mm, 4),
        max_force_n=round(forces.largest_push_n, 1),
        plugged_after_s=round(plugged_after_s, 3),
        limit_duration_s=round(limit_s, 3),
    )
    if abs(depth_mm - settings.depth_mm) > settings.depth_tolerance_mm:
        raise InsertionDepthError(
            f"The plug is {depth_mm:.1f} mm deep instead of {settings.depth_mm:.0f} mm.",
            depth_mm=round(depth_mm, 2),
        )


def _is_jam(error: ForceLimitError | RobotFaultError) -> bool:
    """Whether the plug met too much resistance; any other fault is for a person to look at."""
    return isinstance(error, ForceLimitError) or error.context.get("fault") == FaultCode.STALL.value
