"""Times in which a job rests until a person lets it go on."""

from __future__ import annotations

import asyncio

from server.control.errors import StationUnsafeError
from server.jobs.context import JobContext
from server.jobs.model import JobPhase
from server.jobs.phases import charging
from server.schema.jobs import NeedsPerson


class Interlude:
    """Waits for a person, and sees to it who has control meanwhile.

    A paused job keeps control under a name that says so. A job that asks gives it back, so that
    whoever answers can move the robot first.

    Args:
        context: Of the job.
    """

    def __init__(self, context: JobContext) -> None:
        self._job = context
        self._go_on = asyncio.Event()
        self.waits = False

    async def pause(self, job: JobContext) -> None:
        """Rest until ``end``. A charging car gets no power; if that fails, there is no pause."""
        journal = job.journal
        with self:
            if journal.job.phase is JobPhase.CHARGING:
                try:
                    await charging.suspend(job)
                except StationUnsafeError as error:
                    await journal.note("pause_failed", f"{error.title}: {error.detail}")
                    if not journal.job.paused:
                        return
            if not journal.job.paused:
                await journal.pause("Somebody paused the job. It keeps control of the robot.")
            self._hold_control(", paused")
            try:
                await self._go_on.wait()
            finally:
                self._hold_control("")
            await journal.unpause()

    async def ask(self, needs: NeedsPerson, job: JobContext) -> None:
        """Ask a person, and rest until ``end``."""
        with self:
            if job.journal.job.needs_person != needs:
                await job.journal.ask(needs)
            job.supervisor.give_back(job.lease)
            await self._go_on.wait()
            await job.journal.answered("Somebody has resumed the job.")

    def end(self) -> None:
        """Let the job go on.

        Raises:
            ControlBusyError: somebody else uses the robot.
        """
        self.take_control()
        self._go_on.set()

    def take_control(self) -> None:
        """Take control back, if it was given away.

        Raises:
            ControlBusyError: somebody else uses the robot.
        """
        if self._job.lease.ended:
            self._job.lease = self._job.supervisor.acquire("job", self._title)

    def _hold_control(self, addition: str) -> None:
        """The same control under another name."""
        supervisor = self._job.supervisor
        supervisor.give_back(self._job.lease)
        self._job.lease = supervisor.acquire("job", self._title + addition)

    @property
    def _title(self) -> str:
        return self._job.journal.job.type.in_words

    def __enter__(self) -> None:
        self._go_on.clear()
        self.waits = True

    def __exit__(self, *_: object) -> None:
        self.waits = False
