"""Watches robot, jobs and model, and tells what happens."""

from __future__ import annotations

from collections.abc import Callable

from server.control.model import PlugState
from server.control.supervisor import Supervisor
from server.divergence import DivergenceWatcher
from server.divergence.report import divergence_report
from server.events.log import EventLog
from server.events.person import why_person_needed
from server.jobs.model import JobPhase, JobState
from server.jobs.runner import JobRunner
from server.schema.events import (
    DivergenceChanged,
    DivergenceEvent,
    FaultBegan,
    JobCreated,
    JobEnded,
    JobHappened,
    JobPhaseBegan,
    JobStateChanged,
    NeedsPersonEvent,
    PersonNeeded,
    PlugChanged,
    PlugMoved,
    RobotFaultEvent,
)
from server.schema.jobs import Job
from server.schema.robot import Robot, RobotFault
from server.timing import Calendar
from twin.divergence import Change


class EventSources:
    """Compares what is so with what was so, and tells the difference.

    Args:
        log: Takes the events.
        supervisor: Owner of the robot.
        runner: Runs the jobs.
        divergence: Runs the model beside the robot.
        calendar: Dates.
        robot: The robot as everyone sees it.
        show: Completes a job as everyone sees it.
    """

    def __init__(
        self,
        log: EventLog,
        *,
        supervisor: Supervisor,
        runner: JobRunner,
        divergence: DivergenceWatcher,
        calendar: Calendar,
        robot: Callable[[], Robot],
        show: Callable[[Job], Job],
    ) -> None:
        self._log = log
        self._supervisor = supervisor
        self._runner = runner
        self._calendar = calendar
        self._robot = robot
        self._show = show
        self._job: Job | None = None
        self._plug: PlugState | None = None
        self._condition: object = None
        self._fault_code: str | None = None
        self._needs: RobotFault | None = None
        supervisor.listen(self._robot_changed)
        runner.listen(self._job_changed)
        divergence.listen(self._divergence_changed)

    def _job_changed(self) -> None:
        job, before = self._runner.newest, self._job
        if job is None or job is before:
            return
        self._job = job
        known = before if before is not None and before.id == job.id else None
        if known is None and not job.state.ended:
            self._tell_job(JobCreated, job)
        if job.state.ended:
            if known is None or not known.state.ended:
                self._tell_job(JobEnded, job)
                self._look_for_a_person()
        elif known is not None and _phase(job) != _phase(known):
            self._tell_job(JobPhaseBegan, job)
        elif known is not None and _state(job) != _state(known):
            self._tell_job(JobStateChanged, job)
            self._look_for_a_person()

    def _tell_job(
        self,
        kind: type[JobCreated | JobEnded | JobPhaseBegan | JobStateChanged],
        job: Job,
    ) -> None:
        self._log.tell(
            kind(
                id=self._log.new_id(),
                timestamp=self._calendar.now(),
                data=JobHappened(job=self._show(job)),
            )
        )

    def _robot_changed(self) -> None:
        """Called with every telemetry sample, so it looks closer only when something matters."""
        supervisor = self._supervisor
        state = supervisor.telemetry.latest
        fault = state.fault if state is not None else supervisor.link_trouble
        condition = (supervisor.mode, supervisor.plug.state, fault)
        if condition == self._condition:
            return
        self._condition = condition
        self._tell_plug(supervisor.plug.state)
        self._tell_fault(self._robot().fault)
        self._look_for_a_person()

    def _tell_plug(self, plug: PlugState) -> None:
        if plug is not self._plug:
            moved = PlugMoved(plug=plug, before=self._plug)
            self._plug = plug
            now = self._calendar.now()
            self._log.tell(PlugChanged(id=self._log.new_id(), timestamp=now, data=moved))

    def _tell_fault(self, fault: RobotFault | None) -> None:
        code = fault.code if fault is not None else None
        if fault is not None and code != self._fault_code:
            now = self._calendar.now()
            data = FaultBegan(fault=fault)
            self._log.tell(RobotFaultEvent(id=self._log.new_id(), timestamp=now, data=data))
        self._fault_code = code

    def _look_for_a_person(self) -> None:
        reason = why_person_needed(self._robot(), self._runner.newest)
        before, self._needs = self._needs, reason
        if (reason and reason.code) != (before and before.code):
            now = self._calendar.now()
            data = PersonNeeded(needed=reason is not None, reason=reason)
            self._log.tell(NeedsPersonEvent(id=self._log.new_id(), timestamp=now, data=data))

    def _divergence_changed(self, change: Change) -> None:
        report = divergence_report(change.divergence, self._calendar)
        self._log.tell(
            DivergenceEvent(
                id=self._log.new_id(),
                timestamp=self._calendar.now(),
                data=DivergenceChanged(began=change.began, divergence=report),
            )
        )


def _phase(job: Job) -> tuple[JobPhase, bool]:
    """The first phase stands in the job before the job has begun."""
    return job.phase, job.state is JobState.QUEUED


def _state(job: Job) -> tuple[bool, bool]:
    return job.paused, job.needs_person is not None
