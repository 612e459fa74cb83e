"""Carries out one accepted job: its phases, the way back when they end early, and its end."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Coroutine

from server.control.errors import ControlError
from server.control.model import PlugState, RobotMode
from server.control.modes import why_not_moving
from server.errors import InternalError, PlugPilotError
from server.jobs import sequence
from server.jobs.context import JobContext
from server.jobs.errors import JobCancelledError
from server.jobs.model import JobState
from server.schema.jobs import Job

_log = logging.getLogger(__name__)

STOPPED_BY_A_PERSON = {RobotMode.STOPPED, RobotMode.EMERGENCY_STOP}


class Execution:
    """One job under way; ``run`` is awaited once.

    Args:
        context: What the phases have at hand.
    """

    def __init__(self, context: JobContext) -> None:
        self.context = context
        self._work: asyncio.Task[None] | None = None
        self._on_way_back = False
        self._stopped: ControlError | None = None

    @property
    def job(self) -> Job:
        """The job as it stands."""
        return self.context.journal.job

    async def run(self) -> None:
        """Carry the job out to its end; whatever happens, it does end."""
        try:
            await self._run()
        except PlugPilotError as error:
            # The journal itself failed, so the robot stays where it is.
            _log.exception("the journal of job %s cannot be written", self.job.id)
            self.context.journal.give_up(error)
        except Exception:  # noqa: BLE001 - logged; the job must not look as if it still ran
            _log.exception("job %s ended in a way nobody thought of", self.job.id)
            self.context.journal.give_up(_surprise(self.job))

    async def cancel(self) -> None:
        """Ask the job to go back to safety; changes nothing when it does so already."""
        if self.job.cancel_requested:
            return
        try:
            await self.context.journal.want_cancel()
        finally:
            if not self._on_way_back and sequence.may_be_cancelled(self.job):
                self._interrupt()

    def notice_robot(self) -> None:
        """A stop ends the job in whatever phase it is, so that nothing moves after a reset."""
        supervisor = self.context.supervisor
        if self._stopped is None and supervisor.mode in STOPPED_BY_A_PERSON:
            self._stopped = why_not_moving(supervisor.mode, supervisor.telemetry.latest)
            self._interrupt()

    async def _run(self) -> None:
        journal = self.context.journal
        cause = await self._attempt(sequence.carry_out(self.context))
        if cause is None:
            await journal.end(JobState.SUCCEEDED, "Done.")
            return
        self._on_way_back = True
        hindrance = await self._attempt(sequence.retreat(self.context, cause))
        if hindrance is not None:
            _log.warning("the robot could not go back: %s", hindrance)
            await journal.note(
                "retreat_failed",
                f"{hindrance.title}: {hindrance.detail} {hindrance.remedy}",
                code=hindrance.code,
            )
        if not isinstance(cause, JobCancelledError):
            await journal.end(JobState.FAILED, cause.detail, cause)
        elif hindrance is not None:
            await journal.end(JobState.FAILED, hindrance.detail, hindrance)
        else:
            await journal.end(JobState.CANCELLED, self._where_it_is())

    async def _attempt(self, steps: Coroutine[None, None, None]) -> PlugPilotError | None:
        """Run some steps; returns what ended them early."""
        work = self._work = asyncio.create_task(steps, name="job phases")
        try:
            await asyncio.wait({work})
        except asyncio.CancelledError:  # PlugPilot itself is ending
            self._interrupt()
            await asyncio.wait({work})
            raise
        if work.cancelled():
            return self._stopped or JobCancelledError("Somebody cancelled the job.")
        error = work.exception()
        if error is None or isinstance(error, PlugPilotError):
            return error
        _log.error("a phase failed in a way nobody thought of", exc_info=error)
        return _surprise(self.job)

    def _interrupt(self) -> None:
        # Once only: a second time would interrupt the phase while it brings the robot to rest.
        if self._work is not None and not self._work.cancelling():
            self._work.cancel()

    def _where_it_is(self) -> str:
        match self.context.supervisor.plug.state:
            case PlugState.PARKED:
                return "Cancelled; the robot is back in its parking place."
            case PlugState.INSERTED:
                return "Cancelled; the plug stays in the car."
            case _:
                return "Cancelled; the robot stays where it is."


def _surprise(job: Job) -> InternalError:
    return InternalError(f"The phase {job.phase.value} failed. The log has the details.")
