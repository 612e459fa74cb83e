"""Carries out one accepted job: its phases, its pauses, the way back, and its end."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Awaitable, Callable
from functools import partial

from server.control.errors import ControlError
from server.control.model import PlugState, RobotMode
from server.errors import InternalError, PlugPilotError
from server.jobs import resumption, sequence
from server.jobs.context import JobContext
from server.jobs.errors import CannotPauseError, JobCancelledError, NotPausedError
from server.jobs.interlude import Interlude
from server.jobs.interruptions import JobInterruption, JobPaused, PersonNeeded, TurnedBack
from server.jobs.model import JobPhase, JobState
from server.jobs.turning_back import TurnBack, may_be_cancelled
from server.schema.jobs import Job

_log = logging.getLogger(__name__)

STOPPED_BY_A_PERSON = {RobotMode.STOPPED, RobotMode.EMERGENCY_STOP}

ON_ITS_WAY_OUT = {JobPhase.RELEASING, JobPhase.WITHDRAWING}
"""A plug that is half out is finished with sooner than it is watched over."""

Course = Callable[[JobContext], Awaitable[None]]
"""Phases one after the other."""


class Execution:
    """One job under way; ``run`` is awaited once.

    Args:
        context: What the phases have at hand.
        course: What to do: a new job's phases, or to go on with an interrupted one.
    """

    def __init__(self, context: JobContext, course: Course = sequence.carry_out) -> None:
        self.context = context
        self._course = course
        self._work: asyncio.Task[None] | None = None
        self._interlude = Interlude(context)
        self._reason: PlugPilotError | None = None
        self._on_way_back = False
        self._stopped: ControlError | None = None
        self._stop_entry: asyncio.Task[None] | None = None

    @property
    def job(self) -> Job:
        """The job as it stands."""
        return self.context.journal.job

    async def run(self) -> None:
        """Carry the job out to its end; whatever happens, it does end."""
        try:
            await self._conclude(await self._carry_out())
        except PlugPilotError as error:
            # The journal itself failed, so the robot stays where it is.
            _log.exception("the journal of job %s cannot be written", self.job.id)
            self.context.journal.give_up(error)
        except Exception:  # noqa: BLE001 - logged; the job must not look as if it still ran
            _log.exception("job %s ended in a way nobody thought of", self.job.id)
            self.context.journal.give_up(_surprise(self.job))

    # What people may ask for

    async def cancel(self) -> None:
        """Ask the job to go back to safety; changes nothing when it does so already.

        Raises:
            ControlBusyError: it waits for a person, and somebody else uses the robot.
        """
        if self.job.cancel_requested:
            return
        if self._interlude.waits:
            self._interlude.take_control()
        try:
            await self.context.journal.want_cancel()
        finally:
            stoppable = self._interlude.waits or may_be_cancelled(self.job)
            if not self._on_way_back and stoppable:
                self._interrupt(JobCancelledError("Somebody cancelled the job."))

    def pause(self) -> None:
        """Bring the job to rest until ``resume``; changes nothing when it rests already.

        Raises:
            CannotPauseError: it is on its way out of the car, on its way back, or asks a person.
        """
        job = self.job
        if job.paused or (self._interlude.waits and job.needs_person is None):
            return
        if self._on_way_back or job.cancel_requested or job.phase in ON_ITS_WAY_OUT:
            raise CannotPauseError("The plug is on its way out.", phase=job.phase.value)
        if job.needs_person is not None:
            raise CannotPauseError("The job waits for a person already.")
        self._interrupt(JobPaused("Somebody paused the job."))

    def resume(self) -> None:
        """Let a paused job, or one that has asked a person, go on.

        Raises:
            NotPausedError: it does neither.
            ControlBusyError: somebody else uses the robot meanwhile.
        """
        if not self._interlude.waits:
            raise NotPausedError("The job is neither paused nor does it wait for an answer.")
        self._interlude.end()

    def notice_robot(self) -> None:
        """A stop ends the job in whatever phase it is, so that nothing moves after a reset."""
        supervisor = self.context.supervisor
        if self._stopped is None and supervisor.mode in STOPPED_BY_A_PERSON:
            self._stopped = supervisor.why_not_moving()
            if self._stopped is not None:
                # At once: a power cut before the robot is at rest must not undo the stop.
                turn = TurnBack.because(self.job, self._stopped)
                entry = self.context.journal.turn_back(turn)
                self._stop_entry = asyncio.create_task(entry, name="entry of a stop")
                self._interrupt(self._stopped)

    # Inside

    async def _carry_out(self) -> PlugPilotError | None:
        """Run the phases, with all interludes; returns what ended them early."""
        course = self._course
        if self.job.paused:  # PlugPilot was restarted meanwhile
            cause = await self._attempt(self._interlude.pause)
            if cause is not None:
                return cause
        while True:
            cause = await self._attempt(course)
            if isinstance(cause, JobPaused):
                cause = await self._attempt(self._interlude.pause)
            elif isinstance(cause, PersonNeeded):
                cause = await self._attempt(partial(self._interlude.ask, cause.needs))
            else:
                return cause
            if cause is not None and not isinstance(cause, JobInterruption):
                return cause
            course = resumption.after_pause

    async def _conclude(self, cause: PlugPilotError | None) -> None:
        journal = self.context.journal
        if cause is None:
            await journal.end(JobState.SUCCEEDED, "Done.")
            return
        self._on_way_back = True
        turn = cause.turn if isinstance(cause, TurnedBack) else TurnBack.because(self.job, cause)
        if self._stop_entry is not None:
            await self._stop_entry
        elif not (isinstance(cause, TurnedBack) and cause.written):
            await journal.turn_back(turn)
        hindrance = await self._attempt(lambda context: sequence.go_back(context, turn))
        if hindrance is not None:
            _log.warning("the robot could not go back: %s", hindrance)
            await journal.note(
                "retreat_failed",
                f"{hindrance.title}: {hindrance.detail} {hindrance.remedy}",
                code=hindrance.code,
            )
        if not turn.cancelled:
            await journal.end(JobState.FAILED, turn.problem.detail, turn.problem)
        elif hindrance is not None:
            await journal.end(JobState.FAILED, hindrance.detail, hindrance)
        else:
            await journal.end(JobState.CANCELLED, self._where_it_is())

    async def _attempt(self, course: Course) -> PlugPilotError | None:
        """Run some steps; returns what ended them early."""
        if self._stopped is not None and not self._on_way_back:
            return self._stopped
        work = self._work = asyncio.ensure_future(_as_coroutine(course, self.context))
        self._reason = None
        try:
            await asyncio.wait({work})
        except asyncio.CancelledError:  # PlugPilot itself is ending
            self._interrupt(InternalError("PlugPilot is ending."))
            await asyncio.wait({work})
            raise
        if work.cancelled():
            return self._reason or InternalError("The job's task was cancelled.")
        error = work.exception()
        if error is None or isinstance(error, PlugPilotError):
            return error
        _log.error("a phase failed in a way nobody thought of", exc_info=error)
        return _surprise(self.job)

    def _interrupt(self, reason: PlugPilotError) -> None:
        if self._work is None:
            return
        # A stop outranks everything; of other reasons the last one counts.
        self._reason = self._stopped or reason
        # Once only: a second time would interrupt the phase while it brings the robot to rest.
        if not self._work.cancelling():
            self._work.cancel()

    def _where_it_is(self) -> str:
        match self.context.supervisor.plug.state:
            case PlugState.PARKED:
                return "Cancelled; the robot is back in its parking place."
            case PlugState.INSERTED:
                return "Cancelled; the plug stays in the car."
            case _:
                return "Cancelled; the robot stays where it is."


async def _as_coroutine(course: Course, context: JobContext) -> None:
    await course(context)


def _surprise(job: Job) -> InternalError:
    return InternalError(f"The phase {job.phase.value} failed. The log has the details.")
