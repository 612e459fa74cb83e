"""Accepts jobs, runs one at a time, lets one wait, and knows the newest one."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

from drivers.station import StationDriver
from server.config.settings import Settings
from server.control.errors import ControlBusyError
from server.control.lease import Lease
from server.control.supervisor import Supervisor
from server.jobs.admission import (
    choose_vehicle,
    queued,
    refuse_if_impossible,
    repeated,
    require_vehicle,
)
from server.jobs.context import JobContext
from server.jobs.errors import (
    JobEndedError,
    JobInterruptedError,
    JobNotFoundError,
    JobWaitsForPersonError,
    NotChargingError,
    NotPausedError,
)
from server.jobs.execution import Execution
from server.jobs.journal import Journal
from server.jobs.model import JobPhase, JobState
from server.jobs.recovery import OWN_SILENCE
from server.jobs.resumption import after_restart
from server.jobs.waiting import WaitingJob, refuse_impossible_times
from server.localisation.eye import Eye
from server.localisation.socket_pose import SocketPose
from server.schema.jobs import Job, JobEvent, JobRequest
from server.schema.vehicles import Vehicle
from server.storage.jobs import JobStore
from server.storage.vehicles import VehicleStore
from server.timing import Calendar
from twin.joints import JointPosition


class JobRunner:
    """Accepts jobs, runs them, and knows the newest one.

    One job runs. A second one may wait: for its time, or until the robot is free.

    Args:
        supervisor: Owner of the robot.
        eye: Camera and locator.
        station: The charging station.
        jobs: Where jobs are kept.
        vehicles: Where vehicles are kept.
        settings: The whole configuration.
        calendar: Dates.
        as_taught: Puts the socket of a vehicle where it was taught.
    """

    def __init__(
        self,
        *,
        supervisor: Supervisor,
        eye: Eye,
        station: StationDriver,
        jobs: JobStore,
        vehicles: VehicleStore,
        settings: Settings,
        calendar: Calendar,
        as_taught: Callable[[Vehicle], Vehicle] = lambda vehicle: vehicle,
    ) -> None:
        self.newest: Job | None = None
        self.socket: SocketPose | None = None
        self._supervisor = supervisor
        self._eye = eye
        self._station = station
        self._jobs = jobs
        self._vehicles = vehicles
        self._settings = settings
        self._calendar = calendar
        self._as_taught = as_taught
        self._listeners: list[Callable[[], None]] = []
        self._readers: list[Callable[[Job, JobEvent], None]] = []
        self._accepting = asyncio.Lock()
        self._waiting = WaitingJob(calendar, self._begin_waiting)
        self._left_over = ""  # the job that waited when PlugPilot was started
        self._execution: Execution | None = None
        self._task: asyncio.Task[None] | None = None
        supervisor.listen(self._robot_changed)

    @property
    def waiting(self) -> Job | None:
        """The job that has not begun yet."""
        return self._waiting.job

    def listen(self, listener: Callable[[], None]) -> None:
        """Call ``listener`` after every change of the newest job or the socket's pose."""
        self._listeners.append(listener)

    def listen_to_journal(self, listener: Callable[[Job, JobEvent], None]) -> None:
        """Call ``listener`` with every entry that is written into a job's journal."""
        self._readers.append(listener)

    async def note(self, kind: str, message: str, **data: Any) -> None:  # noqa: ANN401 - JSON
        """Write something that was noticed beside the job into its journal, if one is running.

        Raises:
            StorageError: it cannot be written.
        """
        if self._execution is not None:
            await self._execution.context.journal.note(kind, message, **data)

    async def start(self) -> None:
        """Go on with what a restart has interrupted."""
        unfinished = await self._jobs.unfinished()
        for job in unfinished:
            journal = await self._journal_of(job)
            if job.state is JobState.RUNNING and self._execution is None:
                await self._take_up(journal)
            elif job.state is JobState.QUEUED and self._waiting.job is None:
                self._left_over = job.id
                self._waiting.put(journal)
            else:
                error = JobInterruptedError("Another job has its place.")
                await journal.end(JobState.FAILED, error.detail, error)
        newest = await self._jobs.page(before=None, limit=1)
        if self._execution is None and newest:
            self.newest = newest[0]

    async def close(self) -> None:
        """Stop the robot; the running job goes on after the next start."""
        await self._waiting.close()
        if self._task is not None:
            self._task.cancel()
            await asyncio.wait({self._task})

    async def create(self, request: JobRequest, *, key: str | None, digest: str | None) -> Job:
        """Accept a job, and begin it if it need not wait.

        Args:
            request: What to do.
            key: The Idempotency-Key; the same key with the same request gives the same job.
            digest: Of the request, to tell a repeated one from another one.

        Raises:
            IdempotencyReuseError, UnknownVehicleError, VehicleChoiceError, JobQueueFullError,
            JobWaitsForPersonError, ScheduleError, ControlError, PlugStateError: the job is not
                accepted, and nothing is kept of it.
        """
        async with self._accepting:
            if key is not None:
                known = await self._jobs.by_key(key)
                if known is not None:
                    return repeated(known, digest)
            now = self._calendar.now()
            refuse_impossible_times(request, now)
            vehicle_id, vehicle = await choose_vehicle(request, self._vehicles, self.newest)
            journal = Journal(
                queued(request, vehicle_id, now), self._jobs, self._calendar, self._job_changed
            )
            later = request.not_before is not None and request.not_before > now
            if later or self._execution is not None:
                self._refuse_unanswered()
                self._waiting.require_room()
                await self._jobs.add(journal.job, key=key, digest=digest)
                self._waiting.put(journal)
                self._job_changed(journal.job, None)
                return journal.job
            refuse_if_impossible(request.type, self._supervisor)
            lease = self._supervisor.acquire("job", request.type.in_words)
            try:
                context = self._context_of(journal, vehicle, lease)
                await self._jobs.add(journal.job, key=key, digest=digest)
            except BaseException:
                self._supervisor.give_back(lease)
                raise
            return self._begin(Execution(context))

    async def cancel(self, job_id: str) -> Job:
        """Ask a job to stop and go back to safety; harmless when it is on its way back.

        Raises:
            JobNotFoundError: no such job.
            JobEndedError: it has ended.
            ControlBusyError: it waits for a person, and somebody else uses the robot.
        """
        if self._waiting.has(job_id):
            return await self._waiting.cancel()
        execution = await self._running(job_id)
        await execution.cancel()
        return execution.job

    async def pause(self, job_id: str) -> Job:
        """Let a job come to rest until it is resumed; a charging car gets no power meanwhile.

        Raises:
            JobNotFoundError, JobEndedError: as in ``cancel``.
            CannotPauseError: the plug is on its way out.
        """
        if self._waiting.has(job_id):
            return await self._waiting.pause()
        execution = await self._running(job_id)
        execution.pause()
        return execution.job

    async def resume(self, job_id: str) -> Job:
        """Let a paused job, or one that has asked a person, go on.

        Raises:
            JobNotFoundError, JobEndedError, ControlBusyError: as in ``cancel``.
            NotPausedError: it goes on by itself.
        """
        if self._waiting.has(job_id):
            if not self._waiting.paused:
                raise NotPausedError("The job waits for its time, not for you.")
            return await self._waiting.resume()
        execution = await self._running(job_id)
        execution.resume()
        return execution.job

    async def finish(self, job_id: str) -> Job:
        """End the charging now; the job goes on to unplug.

        Raises:
            JobNotFoundError, JobEndedError: as in ``cancel``.
            NotChargingError: it is not charging.
        """
        if self._waiting.has(job_id):
            raise NotChargingError("The job has not begun.")
        execution = await self._running(job_id)
        job = execution.job
        if job.phase is not JobPhase.CHARGING:
            raise NotChargingError(f"The job is in the phase {job.phase.value}.")
        execution.context.finish.set()
        if job.paused:
            execution.resume()
        return execution.job

    async def wait(self) -> None:
        """Wait until the running job has ended."""
        if self._task is not None:
            await asyncio.shield(self._task)

    async def _journal_of(self, job: Job) -> Journal:
        sequence = await self._jobs.last_sequence(job.id)
        return Journal(job, self._jobs, self._calendar, self._job_changed, sequence=sequence)

    def _context_of(self, journal: Journal, vehicle: Vehicle | None, lease: Lease) -> JobContext:
        state = self._supervisor.telemetry.latest
        return JobContext(
            supervisor=self._supervisor,
            lease=lease,
            eye=self._eye,
            station=self._station,
            vehicle=self._as_taught(vehicle) if vehicle else None,
            settings=self._settings,
            journal=journal,
            accepted_at_s=asyncio.get_running_loop().time(),
            start=state.commanded.position if state else UNKNOWN,
            calendar=self._calendar,
            on_sighting=self._socket_seen,
        )

    async def _begin_waiting(self, journal: Journal) -> None:
        job = journal.job
        async with self._accepting:
            if self._execution is not None:
                raise ControlBusyError("Another job has just begun.")
            vehicle = await require_vehicle(job, self._vehicles)
            lease = self._supervisor.acquire("job", job.type.in_words)
            try:
                if job.id == self._left_over:
                    await self._supervisor.release_fault(lease, *OWN_SILENCE)
                refuse_if_impossible(job.type, self._supervisor)
            except BaseException:
                self._supervisor.give_back(lease)
                raise
            self._waiting.taken()
            self._begin(Execution(self._context_of(journal, vehicle, lease)))

    async def _take_up(self, journal: Journal) -> None:
        """Nobody else moves the robot before it is clear how the job goes on."""
        vehicle = await self._vehicles.get(journal.job.vehicle_id)
        lease = self._supervisor.acquire("job", journal.job.type.in_words)
        self._begin(Execution(self._context_of(journal, vehicle, lease), after_restart))

    def _begin(self, execution: Execution) -> Job:
        self._execution = execution
        self._waiting.robot_is_free(free=False)
        self._job_changed(execution.job, None)
        self._task = asyncio.create_task(self._run(execution), name=f"job {execution.job.id}")
        return execution.job

    async def _run(self, execution: Execution) -> None:
        try:
            await execution.run()
        finally:
            self._supervisor.give_back(execution.context.lease)
            self._execution = None
            self._waiting.robot_is_free(free=True)
            self._changed()

    async def _running(self, job_id: str) -> Execution:
        if self._execution is not None and self._execution.job.id == job_id:
            return self._execution
        job = await self._jobs.get(job_id)
        if job is None:
            raise JobNotFoundError(f"There is no job {job_id}.", job_id=job_id)
        raise JobEndedError(f"The job {_PAST_TENSE[job.state]}.", job_id=job_id)

    def _refuse_unanswered(self) -> None:
        if self._execution is not None:
            needs = self._execution.job.needs_person
            if needs is not None and needs.choices:
                raise JobWaitsForPersonError(needs.sentence, job_id=self._execution.job.id)

    def _robot_changed(self) -> None:
        if self._execution is not None:
            self._execution.notice_robot()

    def _job_changed(self, job: Job, event: JobEvent | None) -> None:
        if self._execution is None or self._execution.job.id == job.id:
            self.newest = job
        self._changed()
        if event is not None:
            for reader in self._readers:
                reader(job, event)

    def _socket_seen(self, socket: SocketPose) -> None:
        self.socket = socket
        self._changed()

    def _changed(self) -> None:
        for listener in self._listeners:
            listener()


UNKNOWN = JointPosition(0.0, 0.0, 0.0)
"""Where the robot is before the board has answered; a job that is taken up asks it first."""

_PAST_TENSE = {
    JobState.QUEUED: "was left behind by a restart",
    JobState.RUNNING: "was left behind by a restart",
    JobState.SUCCEEDED: "has succeeded",
    JobState.FAILED: "has failed",
    JobState.CANCELLED: "was cancelled",
}
