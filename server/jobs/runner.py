"""Accepts jobs, runs one at a time, and knows the newest one."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

from uuid6 import uuid7

from drivers.station import StationDriver
from server.config.settings import Settings
from server.control.lease import Lease
from server.control.supervisor import Supervisor
from server.jobs.admission import choose_vehicle, refuse_if_impossible, repeated
from server.jobs.context import JobContext
from server.jobs.errors import (
    JobEndedError,
    JobInterruptedError,
    JobNotFoundError,
    JobRunningError,
    NotChargingError,
)
from server.jobs.execution import Execution
from server.jobs.journal import Journal
from server.jobs.model import JobPhase, JobState, JobType
from server.localisation.eye import Eye
from server.localisation.socket_pose import SocketPose
from server.schema.jobs import Job, JobEvent, JobRequest, JobResult
from server.schema.vehicles import Vehicle
from server.storage.jobs import JobStore
from server.storage.vehicles import VehicleStore
from server.timing import Calendar


class JobRunner:
    """Accepts jobs, runs them, and knows the newest one.

    Args:
        supervisor: Owner of the robot.
        eye: Camera and locator.
        station: The charging station.
        jobs: Where jobs are kept.
        vehicles: Where vehicles are kept.
        settings: The whole configuration.
        calendar: Dates.
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
        self._listeners: list[Callable[[], None]] = []
        self._readers: list[Callable[[Job, JobEvent], None]] = []
        self._accepting = asyncio.Lock()
        self._execution: Execution | None = None
        self._task: asyncio.Task[None] | None = None
        supervisor.listen(self._robot_changed)

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
        """Close the books on jobs that a restart interrupted."""
        for job in await self._jobs.unfinished():
            journal = Journal(
                job,
                self._jobs,
                self._calendar,
                self._job_changed,
                sequence=await self._jobs.last_sequence(job.id),
            )
            error = JobInterruptedError(f"The job was in the phase {job.phase.value}.")
            await journal.end(JobState.FAILED, error.title, error)
        newest = await self._jobs.page(before=None, limit=1)
        self.newest = newest[0] if newest else None

    async def close(self) -> None:
        """Stop the robot; the running job is closed as interrupted at the next start."""
        if self._task is not None:
            self._task.cancel()
            await asyncio.wait({self._task})

    async def create(self, request: JobRequest, *, key: str | None, digest: str | None) -> Job:
        """Accept a job and begin it.

        Args:
            request: What to do.
            key: The Idempotency-Key; the same key with the same request gives the same job.
            digest: Of the request, to tell a repeated one from another one.

        Raises:
            IdempotencyReuseError, UnknownVehicleError, VehicleChoiceError, JobRunningError,
            ControlError, PlugStateError: the job is not accepted, and nothing is kept of it.
        """
        async with self._accepting:
            if key is not None:
                known = await self._jobs.by_key(key)
                if known is not None:
                    return repeated(known, digest)
            vehicle_id, vehicle = await choose_vehicle(request, self._vehicles, self.newest)
            self._refuse_if_busy()
            refuse_if_impossible(request.type, self._supervisor)
            lease = self._supervisor.acquire("job", _TITLES[request.type])
            try:
                context = self._context_of(
                    _queued(request, vehicle_id, self._calendar), vehicle, lease
                )
                await self._jobs.add(context.journal.job, key=key, digest=digest)
                return self._begin(context)
            except BaseException:
                self._supervisor.give_back(lease)
                raise

    async def cancel(self, job_id: str) -> Job:
        """Ask a job to stop and go back to safety; harmless when it is on its way back.

        Raises:
            JobNotFoundError: no such job.
            JobEndedError: it has ended.
        """
        execution = await self._running(job_id)
        await execution.cancel()
        return execution.job

    async def finish(self, job_id: str) -> Job:
        """End the charging now; the job goes on to unplug.

        Raises:
            JobNotFoundError, JobEndedError: as in ``cancel``.
            NotChargingError: it is not charging.
        """
        execution = await self._running(job_id)
        phase = execution.job.phase
        if phase is not JobPhase.CHARGING:
            raise NotChargingError(f"The job is in the phase {phase.value}.")
        execution.context.finish.set()
        return execution.job

    async def wait(self) -> None:
        """Wait until the running job has ended."""
        if self._task is not None:
            await asyncio.shield(self._task)

    def _context_of(self, job: Job, vehicle: Vehicle | None, lease: Lease) -> JobContext:
        return JobContext(
            supervisor=self._supervisor,
            lease=lease,
            eye=self._eye,
            station=self._station,
            vehicle=vehicle,
            settings=self._settings,
            journal=Journal(job, self._jobs, self._calendar, self._job_changed),
            accepted_at_s=asyncio.get_running_loop().time(),
            start=self._supervisor.telemetry.require().commanded.position,
            on_sighting=self._socket_seen,
        )

    def _begin(self, context: JobContext) -> Job:
        execution = self._execution = Execution(context)
        self._job_changed(execution.job, None)
        self._task = asyncio.create_task(self._run(execution), name=f"job {execution.job.id}")
        return execution.job

    async def _run(self, execution: Execution) -> None:
        try:
            await execution.run()
        finally:
            self._supervisor.give_back(execution.context.lease)
            self._execution = None
            self._changed()

    async def _running(self, job_id: str) -> Execution:
        if self._execution is not None and self._execution.job.id == job_id:
            return self._execution
        job = await self._jobs.get(job_id)
        if job is None:
            raise JobNotFoundError(f"There is no job {job_id}.", job_id=job_id)
        raise JobEndedError(f"The job {_PAST_TENSE[job.state]}.", job_id=job_id)

    def _refuse_if_busy(self) -> None:
        if self._execution is not None:
            running = self._execution.job
            raise JobRunningError(
                f"{_TITLES[running.type]} is in the phase {running.phase.value}.",
                job_id=running.id,
            )

    def _robot_changed(self) -> None:
        if self._execution is not None:
            self._execution.notice_robot()

    def _job_changed(self, job: Job, event: JobEvent | None) -> None:
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


_TITLES = {
    JobType.CHARGE: "Charging job",
    JobType.PLUG_IN: "Plug-in job",
    JobType.UNPLUG: "Unplugging job",
}

_PAST_TENSE = {
    JobState.QUEUED: "was left behind by a restart",
    JobState.RUNNING: "was left behind by a restart",
    JobState.SUCCEEDED: "has succeeded",
    JobState.FAILED: "has failed",
    JobState.CANCELLED: "was cancelled",
}


def _queued(request: JobRequest, vehicle_id: str, calendar: Calendar) -> Job:
    now = calendar.now()
    return Job(
        id=str(uuid7()),
        type=request.type,
        state=JobState.QUEUED,
        phase=JobPhase.PREFLIGHT,
        vehicle_id=vehicle_id,
        target_energy_wh=request.target_energy_wh,
        created_at=now,
        updated_at=now,
        phase_started_at=now,
        cancel_requested=False,
        result=JobResult(),
        error=None,
    )
