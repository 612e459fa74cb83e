"""Keeps the outlook of the running job, and learns from every job that succeeds."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime, timedelta

from drivers.station import StationSnapshot
from server.config.settings import Settings
from server.control.supervisor import Supervisor
from server.jobs.model import JobPhase, JobState
from server.jobs.outlook.milestones import Charge, Sight, outlook
from server.jobs.outlook.phase_times import LATEST, PhaseTimes
from server.jobs.outlook.progress import Progress
from server.jobs.outlook.steady_power import SteadyPower
from server.jobs.runner import JobRunner
from server.schema.jobs import Job, JobEvent
from server.schema.outlook import Outlook
from server.storage.jobs import PHASE_STARTED, JobStore
from server.timing import Calendar

SAME = timedelta(seconds=1)
SAME_PART = 0.05
"""What moves by less of what is left is the same to whoever waits, and is not sent again."""


class OutlookWatch:
    """Knows when the running job reaches its next milestone.

    Args:
        runner: Runs the jobs.
        supervisor: Owner of the robot.
        jobs: Where jobs and their journals are kept.
        settings: The whole configuration.
        calendar: Dates.
    """

    def __init__(
        self,
        *,
        runner: JobRunner,
        supervisor: Supervisor,
        jobs: JobStore,
        settings: Settings,
        calendar: Calendar,
    ) -> None:
        self._runner = runner
        self._supervisor = supervisor
        self._jobs = jobs
        self._lead = timedelta(seconds=settings.jobs.unplug_lead_s)
        self._calendar = calendar
        self._times = PhaseTimes(settings.phase_times)
        self._job_id = ""
        self._journal: list[JobEvent] = []
        self._progress = Progress()
        self._power = SteadyPower()
        self._counter_wh: float | None = None
        self._shown: Outlook | None = None
        self._listeners: list[Callable[[], None]] = []
        runner.listen_to_journal(self._written)

    def listen(self, listener: Callable[[], None]) -> None:
        """Call ``listener`` whenever the outlook may have changed."""
        self._listeners.append(listener)

    async def start(self) -> None:
        """Read what earlier jobs have taken, and how far an interrupted one has come.

        Before the runner goes on with that one.

        Raises:
            StorageError: the jobs cannot be read.
        """
        for job in reversed(await self._jobs.succeeded(LATEST)):
            self._times.learn(await self._jobs.events(job.id))
        for job in await self._jobs.unfinished():
            if job.state is JobState.RUNNING:
                self._take(job)
                for event in await self._jobs.events(job.id):
                    self._add(event)
                self._progress = self._progress.interrupted()
                break

    def station_read(self, snapshot: StationSnapshot | None) -> None:
        """The station was read; None when it does not answer."""
        stage = self._progress.stage
        if snapshot is None or stage is None or stage.phase is not JobPhase.CHARGING:
            self._power.forget()
            self._counter_wh = None
        else:
            self._power.read(snapshot.power_w, snapshot.sampled_at_s)
            self._counter_wh = snapshot.session_energy_wh
        self._changed()

    def now(self) -> Outlook | None:
        """The outlook as far as it can be told at this moment."""
        job = self._runner.newest
        if job is None or job.id != self._job_id:
            return None
        telemetry = self._supervisor.telemetry.latest
        seen = Sight(
            job=job,
            progress=self._progress,
            plug=self._supervisor.plug.state,
            homed=telemetry is not None and telemetry.homed,
            charge=Charge(
                left_wh=self._left_wh(job), power_w=self._power.power_w, unplug_lead=self._lead
            ),
            now=self._calendar.now(),
            clock_speed=self._calendar.speed,
        )
        return outlook(seen, self._times)

    def shown(self) -> Outlook | None:
        """The same, left as it was shown last when it has hardly moved."""
        new = self.now()
        if new is None or self._shown is None or _moved(self._shown, new, self._calendar.now()):
            self._shown = new
        return self._shown

    def _left_wh(self, job: Job) -> float | None:
        before_wh, counter_wh = self._progress.energy_before_wh, self._counter_wh
        if job.target_energy_wh is None or before_wh is None or counter_wh is None:
            return None
        return job.target_energy_wh - (counter_wh - before_wh)

    def _written(self, job: Job, event: JobEvent) -> None:
        if job.id != self._job_id:
            if event.kind != PHASE_STARTED:
                return  # of a job that has not begun
            self._take(job)
        self._add(event)
        if event.kind == JobState.SUCCEEDED:
            self._times.learn(self._journal)
        if job.state.ended:
            self._job_id = ""
        self._changed()

    def _take(self, job: Job) -> None:
        """From now on it is about another job."""
        self._job_id = job.id
        self._journal, self._progress = [], Progress()
        self._power.forget()

    def _add(self, event: JobEvent) -> None:
        self._journal.append(event)
        self._progress = self._progress.after(event)

    def _changed(self) -> None:
        for listener in self._listeners:
            listener()


def _moved(shown: Outlook, new: Outlook, now: datetime) -> bool:
    if (shown.milestone, shown.latest) != (new.milestone, new.latest):
        return True
    return abs(new.at - shown.at) > max(SAME, SAME_PART * (new.at - now))
