"""One pull out of the socket: along the insertion axis, under a watch."""

from __future__ import annotations

from server.control.errors import ControlError
from server.control.force_curve import ForceCurve
from server.control.plug_guard import Corridor
from server.control.plug_watch import PlugWatch
from server.jobs.context import JobContext
from server.jobs.errors import StillLockedError
from server.jobs.plugging.resistance import is_resistance
from twin.force_band import ForceBand
from twin.kinematics import gamma
from twin.motion import plan_straight_line


async def pull_out(job: JobContext) -> ForceCurve:
    """Pull the plug out; it is free afterwards. The load guard must be watching.

    Where the plug is known, it goes back to where the insertion began. Where it is not, or the
    slide has lost its position, it goes all the way back along the axis, to the switch.

    Returns:
        What was measured on the way.

    Raises:
        StillLockedError: it takes more than the allowed force; says how far the plug came.
        StillUnderLoadError, StationUnsafeError: the motion was stopped.
        ControlError: the robot was stopped, or stopped for another reason.
    """
    supervisor, settings = job.supervisor, job.settings.insertion
    # A plug that jammed on the way in may have made the board stall.
    await supervisor.release_stall(job.lease)
    await supervisor.set_force_limit(job.lease, settings.withdrawal_force_limit_n)
    corridor = supervisor.plug.corridor
    known = corridor is not None and supervisor.telemetry.require().homed
    watch = PlugWatch(
        job.settings.supervision,
        limit_n=settings.withdrawal_force_limit_n,
        face_rho3_mm=corridor.face_rho3_mm if corridor is not None and known else None,
        band=ForceBand(settings.withdrawal_band),
    )
    began_mm = supervisor.telemetry.require().measured.position.rho3_mm
    try:
        if corridor is not None and known:
            await _back_to_the_beginning(job, corridor, watch)
        else:
            await supervisor.withdraw_home(job.lease)
    except ControlError as error:
        if not is_resistance(error, settings.withdrawal_force_limit_n):
            raise
        raise _still_locked(job, error, watch, began_mm) from error
    await supervisor.plug.is_free()
    return watch.curve


async def _back_to_the_beginning(job: JobContext, corridor: Corridor, watch: PlugWatch) -> None:
    supervisor = job.supervisor
    at = supervisor.telemetry.require().commanded.position
    if at.rho3_mm <= corridor.clear_rho3_mm:
        return
    clear = gamma.forward(supervisor.geometry, at._replace(rho3_mm=corridor.clear_rho3_mm))
    plan = plan_straight_line(supervisor.geometry, supervisor.limits, at, clear)
    await supervisor.follow(job.lease, plan, watch.check)


def _still_locked(
    job: JobContext, error: ControlError, watch: PlugWatch, began_mm: float
) -> StillLockedError:
    state = job.supervisor.telemetry.latest
    moved_mm = 0.0
    if state is not None:
        moved_mm = max(began_mm - state.measured.position.rho3_mm, 0.0)
    return StillLockedError(
        f"{error.detail} The plug came {moved_mm:.1f} mm out; the connector is still locked, or "
        "something holds it.",
        moved_mm=round(moved_mm, 1),
        max_pull_n=round(watch.curve.largest_pull_n, 1),
    )
