"""One push into the socket: along the insertion axis, under a watch, with what it measured."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import AsyncIterator
from dataclasses import dataclass

from server.config.insertion import InsertionSettings
from server.control.errors import ControlError, ForceBelowBandError
from server.control.force_curve import ForceCurve
from server.control.plug_guard import Corridor
from server.control.plug_watch import PlugWatch
from server.jobs.approach import corridor
from server.jobs.context import JobContext
from server.jobs.plugging.resistance import is_resistance
from twin.force_band import ForceBand
from twin.kinematics import gamma
from twin.motion import plan_straight_line

_log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class Push:
    """What came of a push.

    Attributes:
        depth_mm: How deep the plug is now.
        curve: Force over depth.
        hindrance: What ended it early: resistance, or none where a socket should give some.
    """

    depth_mm: float
    curve: ForceCurve
    hindrance: ControlError | None

    @property
    def met_nothing(self) -> bool:
        """There is no socket where it should be."""
        return isinstance(self.hindrance, ForceBelowBandError)


async def push_in(job: JobContext) -> Push:
    """Push the plug in from where it stands. The load guard must be watching.

    Raises:
        StillUnderLoadError, StationUnsafeError: the motion was stopped; the plug is where it is.
        ControlError: the robot was stopped, or stopped for a reason that is not in the socket.
    """
    supervisor, settings = job.supervisor, job.settings.insertion
    geometry, socket = supervisor.geometry, job.require_socket()
    at = supervisor.telemetry.require().commanded.position
    way = corridor(geometry, at, socket, settings)
    watch = PlugWatch(
        job.settings.supervision,
        limit_n=settings.force_limit_n,
        face_rho3_mm=way.face_rho3_mm,
        band=ForceBand(settings.band),
    )
    # On disk before the plug can touch the socket.
    await supervisor.plug.about_to_enter(way)
    seated = at._replace(rho3_mm=way.depth_rho3_mm)
    plan = plan_straight_line(geometry, supervisor.limits, at, gamma.forward(geometry, seated))
    hindrance: ControlError | None = None
    try:
        async with _harder_once_guided(job, way):
            await supervisor.follow(job.lease, plan, watch.check)
    except ControlError as error:
        met_nothing = isinstance(error, ForceBelowBandError)
        if not (met_nothing or is_resistance(error, _limit_n(settings, watch.curve))):
            raise
        hindrance = error
    depth_mm = supervisor.telemetry.require().measured.position.rho3_mm - way.face_rho3_mm
    return Push(depth_mm, watch.curve, hindrance)


def _limit_n(settings: InsertionSettings, curve: ForceCurve) -> float:
    """The force that was allowed where the plug came to rest [N]."""
    guided = bool(curve.points) and curve.points[-1][0] >= settings.guide_depth_mm
    return settings.force_limit_n if guided else settings.contact_force_limit_n


@contextlib.asynccontextmanager
async def _harder_once_guided(job: JobContext, way: Corridor) -> AsyncIterator[None]:
    """Let the board push hard only where the socket guides the plug.

    A plug that misses the opening then meets the panel with little force. If the change of the
    limit does not reach the board, the plug stops at the lower one.
    """
    supervisor, settings = job.supervisor, job.settings.insertion
    guided_mm = way.face_rho3_mm + settings.guide_depth_mm
    softly_n = min(settings.contact_force_limit_n, settings.force_limit_n)
    await supervisor.set_force_limit(job.lease, softly_n)

    async def raise_limit() -> None:
        state = supervisor.telemetry.require()
        while state.measured.position.rho3_mm < guided_mm:
            state = await supervisor.telemetry.next()
        await supervisor.set_force_limit(job.lease, settings.force_limit_n)

    raising = asyncio.create_task(raise_limit(), name="force limit")
    try:
        yield
    finally:
        raising.cancel()
        outcome = (await asyncio.gather(raising, return_exceptions=True))[0]
        if isinstance(outcome, Exception):
            _log.warning("the force limit stayed at %.0f N: %s", softly_n, outcome)
