"""Watches the jobs: what people do by hand counts more than what the energy manager wants."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from server.charge_point.memory import RecordKeeper
from server.config.charge_point import ChargePointSettings
from server.jobs.model import JobPhase, JobState, JobType
from server.jobs.runner import JobRunner
from server.schema.charge_point import RestReason
from server.schema.jobs import Job, JobEvent

OnCharging = Callable[[Job], None]


class JobWatch:
    """Keeps the record true to what jobs and people do.

    Args:
        runner: Runs the jobs.
        keeper: Holds the record.
        settings: Gives what holds now.
        charging: Called when a job begins to charge.

    Attributes:
        forbidden: The energy manager has said that the car may not charge.
        pausing: The job that the energy manager has just paused.
        ending: The job that the energy manager ends, or unplugs by.
    """

    def __init__(
        self,
        runner: JobRunner,
        keeper: RecordKeeper,
        settings: Callable[[], ChargePointSettings],
        *,
        charging: OnCharging,
    ) -> None:
        self.forbidden = False
        self.pausing: str | None = None
        self.ending: str | None = None
        self._runner = runner
        self._keeper = keeper
        self._settings = settings
        self._charging = charging
        runner.listen_to_journal(self._written)

    @property
    def running(self) -> Job | None:
        """The job under way; one that waits for its time is none."""
        job, waiting = self._runner.newest, self._runner.waiting
        if job is None or job.state.ended or (waiting is not None and waiting.id == job.id):
            return None
        return job

    def end_rest(self) -> None:
        """What has been is forgotten."""
        self.forbidden = False
        self._keeper.keep(replace(self._keeper.record, resting=None, failures=0))

    def _written(self, job: Job, event: JobEvent) -> None:
        match event.kind:
            case "phase_started":
                self._phase_began(job)
            case "cancel_requested" if job.id != self.ending:
                self._rest("unplugged")
            case "paused":
                self._paused(job)
            case _ if job.state.ended:
                self._ended(job)
            case _:
                pass

    def _phase_began(self, job: Job) -> None:
        ours = job.id == self._keeper.record.job_id
        if job.phase is JobPhase.PREFLIGHT and job.type is not JobType.UNPLUG and not ours:
            self.end_rest()  # somebody wants the car plugged in
        if job.phase is JobPhase.PREFLIGHT and job.type is JobType.UNPLUG and job.id != self.ending:
            self._rest("unplugged")
        if job.phase is JobPhase.CHARGING:
            self._charging(job)

    def _paused(self, job: Job) -> None:
        """A job that a person has paused is no longer the energy manager's to resume."""
        record = self._keeper.record
        if self.pausing != job.id and record.job_id == job.id:
            self._keeper.keep(replace(record, job_id=None))
        self.pausing = None

    def _ended(self, job: Job) -> None:
        record = self._keeper.record
        if job.state is JobState.SUCCEEDED:
            self._keeper.keep(replace(record, failures=0))
            if job.type is JobType.CHARGE:
                self._rest("charged")
        elif job.state is JobState.FAILED and job.id == record.job_id:
            failures = record.failures + 1
            self._keeper.keep(replace(record, enabled=False, failures=failures))
            if failures >= self._settings().attempts:
                self._rest("failed")

    def _rest(self, reason: RestReason) -> None:
        self.forbidden = False
        self._keeper.keep(replace(self._keeper.record, enabled=False, resting=reason))
