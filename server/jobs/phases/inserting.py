"""Push the plug in along the insertion axis; when it jams, draw it back, measure and try again."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator

from server.control.errors import StationUnsafeError, StillUnderLoadError
from server.jobs.approach import AT_THE_CENTRE, LateralOffset, lateral_error_mm
from server.jobs.context import JobContext
from server.jobs.errors import InsertionDepthError, InsertionJammedError, JobError, PlugMissedError
from server.jobs.model import JobPhase
from server.jobs.plugging.measuring import stand_before_socket
from server.jobs.plugging.power_off import forbid_power
from server.jobs.plugging.pulling import pull_out
from server.jobs.plugging.pushing import Push, push_in
from server.jobs.plugging.search import further_tries
from server.jobs.plugging.seating import is_seated
from twin.joints import JointPosition
from twin.motion import minimum_time_s

INTERRUPTIONS = 3
"""So often somebody may switch the station on, or it may fall silent, while the plug goes in."""


async def run(job: JobContext) -> None:
    """Insert to the full depth.

    Raises:
        InsertionJammedError: the plug did not go in at any of its tries; it is drawn back.
        PlugMissedError: there is no socket where it should be; the plug is drawn back.
        InsertionDepthError: the plug came to rest at the wrong depth.
        StillLockedError: it went neither in nor out.
        StillUnderLoadError, StationUnsafeError: there is no proof that no current flows.
        ControlError: the robot was stopped, or stopped for another reason.
    """
    await job.journal.begin(JobPhase.INSERTING, "Pushing the plug in.")
    # Somebody may switch the station on at any moment, and with the plug half in that is too late.
    await forbid_power(job.station)
    await _measure_again_if_old(job)
    offset, tries, made = AT_THE_CENTRE, further_tries(job.settings.insertion), 0
    while True:
        begins_at = job.supervisor.telemetry.require().commanded.position
        push = await _push_without_load(job)
        made += 1
        if is_seated(push, job.settings.insertion):
            break
        await _note_try(job, push, offset, made)
        async with job.supervisor.plug_may_move(job.settings.supervision.proof_patience_s):
            await pull_out(job)
        next_offset = _next(job, push, tries, made)
        if next_offset is None or not job.supervisor.telemetry.require().homed:
            raise _why_not_in(job, push, made)
        offset = next_offset
        await stand_before_socket(job, offset)
    await _note_seated(job, push, offset, begins_at)


async def _measure_again_if_old(job: JobContext) -> None:
    """After a pause, or a long wait, the car may stand elsewhere than in the last picture."""
    socket, settings = job.require_socket(), job.settings.supervision
    age_s = asyncio.get_running_loop().time() - socket.measured_at_s
    if age_s > settings.camera_age_s or not socket.from_standstill:
        await job.journal.note(
            "measured_again", f"The last picture is {age_s:.0f} s old.", age_s=round(age_s, 1)
        )
        await stand_before_socket(job)


async def _push_without_load(job: JobContext) -> Push:
    """One push; a station that is switched on, or silent, meanwhile makes it wait on the way."""
    patience_s = job.settings.supervision.proof_patience_s
    for interruptions in range(INTERRUPTIONS + 1):
        try:
            async with job.supervisor.load.watching(patience_s if interruptions else 0.0):
                return await push_in(job)
        except (StillUnderLoadError, StationUnsafeError) as error:
            if interruptions == INTERRUPTIONS:
                raise
            await job.journal.note(
                "insertion_waits",
                f"Stopped on the way in. {error.detail}",
                code=error.code,
                **error.context,
            )
            await forbid_power(job.station)
    raise AssertionError("the last interruption was raised")


def _next(
    job: JobContext, push: Push, tries: Iterator[LateralOffset], made: int
) -> LateralOffset | None:
    """Where to try again; None when that is of no use.

    A plug that jams deep in the socket is well aligned: one more try from a new measurement is all
    that can help. Where no socket is, there is nothing to search for.
    """
    deep = push.depth_mm > job.settings.insertion.guide_depth_mm
    if push.met_nothing or (deep and made > 1):
        return None
    return next(tries, None)


async def _note_try(job: JobContext, push: Push, offset: LateralOffset, made: int) -> None:
    """What this try has seen, for whoever wants to know why the plug did not go in."""
    reason = push.hindrance.detail if push.hindrance else "It came to rest too early."
    await job.journal.note(
        "insertion_try",
        f"Try {made}: the plug came {push.depth_mm:.1f} mm deep. {reason}",
        number=made,
        depth_mm=round(push.depth_mm, 2),
        max_force_n=round(push.curve.largest_push_n, 1),
        right_mm=round(offset.right_mm, 2),
        up_mm=round(offset.up_mm, 2),
        reason=push.hindrance.code if push.hindrance else InsertionDepthError.code,
        force_n_over_depth_mm=push.curve.summary(),
    )


def _why_not_in(job: JobContext, push: Push, made: int) -> JobError:
    wanted_mm = job.settings.insertion.depth_mm
    facts = {
        "depth_mm": round(push.depth_mm, 2),
        "max_force_n": round(push.curve.largest_push_n, 1),
        "tries": made,
    }
    if push.hindrance is None:
        return InsertionDepthError(
            f"The plug is {push.depth_mm:.1f} mm deep instead of {wanted_mm:.0f} mm.", **facts
        )
    if push.met_nothing:
        return PlugMissedError(push.hindrance.detail, **facts)
    tried = f"Tried {made} times. " if made > 1 else ""
    return InsertionJammedError(
        f"{tried}{push.hindrance.detail} The plug was {push.depth_mm:.1f} mm deep of "
        f"{wanted_mm:.0f} mm.",
        **facts,
    )


async def _note_seated(
    job: JobContext, push: Push, offset: LateralOffset, began: JointPosition
) -> None:
    supervisor = job.supervisor
    if push.hindrance is not None:
        # The board may have stalled at the end stop; the plug is where it should be.
        await supervisor.release_stall(job.lease)
    # The way in that this push took; the joints across it have not moved since.
    seated = began._replace(rho3_mm=supervisor.telemetry.require().measured.position.rho3_mm)
    limit_s = minimum_time_s(supervisor.limits, job.start, began) + minimum_time_s(
        supervisor.limits, began, seated
    )
    axis_error_mm = lateral_error_mm(supervisor.geometry, began, job.require_socket(), offset)
    plugged_after_s = asyncio.get_running_loop().time() - job.accepted_at_s
    stopped = " It met its end stop there." if push.hindrance is not None else ""
    await job.journal.measured(
        "seated",
        f"The plug is {push.depth_mm:.1f} mm deep.{stopped}",
        insertion_depth_mm=round(push.depth_mm, 3),
        lateral_error_mm=round(axis_error_mm, 4),
        max_force_n=round(push.curve.largest_push_n, 1),
        plugged_after_s=round(plugged_after_s, 3),
        limit_duration_s=round(limit_s, 3),
    )
