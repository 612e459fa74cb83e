"""The one job that waits: for its time, for the running job, for the robot."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from datetime import datetime

from server.control.errors import ControlBusyError, RobotOfflineError
from server.errors import PlugPilotError
from server.jobs.errors import JobQueueFullError, ScheduleError, ScheduleMissedError
from server.jobs.journal import Journal
from server.jobs.model import JobState
from server.schema.jobs import Job, JobRequest
from server.timing import Calendar

LOOK_AGAIN_S = 10.0
"""The calendar is asked this often, because the clock may be set while a job waits."""

FINEST_S = 0.05

TRY_AGAIN_S = 1.0
"""While somebody else uses the robot, or it does not answer."""

Begin = Callable[[Journal], Awaitable[None]]
"""Begins a job whose time has come; raises what speaks against it."""


def refuse_impossible_times(request: JobRequest, now: datetime) -> None:
    """Refuse a schedule that cannot be kept.

    Raises:
        ScheduleError: with the reason.
    """
    if request.unplug_by is None:
        return
    if request.unplug_by <= now:
        raise ScheduleError("The time to unplug by is over.", now=now.isoformat())
    if request.not_before is not None and request.unplug_by <= request.not_before:
        raise ScheduleError("The car would have to be unplugged before the job may begin.")


async def until(date: datetime, calendar: Calendar) -> None:
    """Wait until a date, also if the clock is set meanwhile."""
    while (left_s := (date - calendar.now()).total_seconds()) > 0:  # noqa: ASYNC110 - a clock
        await asyncio.sleep(min(max(left_s, FINEST_S), LOOK_AGAIN_S))


class WaitingJob:
    """Room for one job that has not begun.

    Args:
        calendar: Dates.
        begin: Begins it.
    """

    def __init__(self, calendar: Calendar, begin: Begin) -> None:
        self._calendar = calendar
        self._begin = begin
        self._journal: Journal | None = None
        self._task: asyncio.Task[None] | None = None
        self._robot_free = asyncio.Event()
        self._robot_free.set()
        self._resumed = asyncio.Event()

    @property
    def job(self) -> Job | None:
        """The job that waits."""
        return self._journal.job if self._journal is not None else None

    @property
    def paused(self) -> bool:
        """There is a job, and somebody has paused it."""
        return self._journal is not None and self._journal.job.paused

    def has(self, job_id: str) -> bool:
        """Whether it is this job that waits."""
        return self._journal is not None and self._journal.job.id == job_id

    def require_room(self) -> None:
        """Make sure that a job can wait.

        Raises:
            JobQueueFullError: another one does.
        """
        if self._journal is not None:
            waiting = self._journal.job
            raise JobQueueFullError(f"{waiting.type.in_words} waits to begin.", job_id=waiting.id)

    def put(self, journal: Journal) -> None:
        """Let a job wait from now on."""
        self._journal = journal
        self._task = asyncio.create_task(self._wait(journal), name="waiting job")

    def robot_is_free(self, *, free: bool) -> None:
        """Whether another job is running."""
        (self._robot_free.set if free else self._robot_free.clear)()

    async def cancel(self) -> Job:
        """End the job before it begins."""
        journal = self._take_out()
        await journal.want_cancel()
        await journal.end(JobState.CANCELLED, "Cancelled before it began.")
        return journal.job

    async def pause(self) -> Job:
        """Keep the job from beginning; changes nothing when it is paused already."""
        journal = self._require_journal()
        if not journal.job.paused:
            self._resumed.clear()
            await journal.pause("Somebody paused the job before it began.")
        return journal.job

    async def resume(self) -> Job:
        """Let a paused job begin when its time has come."""
        journal = self._require_journal()
        await journal.unpause()
        self._resumed.set()
        return journal.job

    async def close(self) -> None:
        """Stop waiting; the job waits on after the next start."""
        if self._task is not None:
            self._task.cancel()
            await asyncio.wait({self._task})

    async def _wait(self, journal: Journal) -> None:
        told = False
        while True:
            await self._until_due(journal)
            try:
                self._refuse_missed(journal.job)
                await self._begin(journal)
            except (ControlBusyError, RobotOfflineError) as error:
                if not told:
                    await journal.note("waits", f"{error.detail} The job waits for that.")
                    told = True
                await asyncio.sleep(TRY_AGAIN_S)
            except PlugPilotError as error:
                self._journal = None
                await journal.end(JobState.FAILED, error.detail, error)
                return
            else:
                return

    async def _until_due(self, journal: Journal) -> None:
        """Until its date has come, nothing else runs and nobody has paused it, all at once."""
        while True:
            if journal.job.not_before is not None:
                await until(journal.job.not_before, self._calendar)
            if journal.job.paused:
                await self._resumed.wait()
            elif not self._robot_free.is_set():
                await self._robot_free.wait()
            else:
                return

    def _refuse_missed(self, job: Job) -> None:
        if job.unplug_by is not None and self._calendar.now() >= job.unplug_by:
            raise ScheduleMissedError(
                f"The car was to be unplugged by {job.unplug_by:%d %b %H:%M} UTC, and only now "
                "could the job have begun."
            )

    def taken(self) -> None:
        """The job has begun: there is room for another one."""
        self._journal = None

    def _take_out(self) -> Journal:
        journal = self._require_journal()
        if self._task is not None:
            self._task.cancel()
        self._journal = None
        return journal

    def _require_journal(self) -> Journal:
        if self._journal is None:
            raise AssertionError("no job waits")
        return self._journal
