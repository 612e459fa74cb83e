"""Runs one job at a time, from acceptance to its end."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import Callable

from uuid6 import uuid7

from drivers.station import StationDriver
from server.config.settings import Settings
from server.control.lease import Lease
from server.control.model import PlugState, RobotMode
from server.control.modes import why_not_moving
from server.control.supervisor import Supervisor
from server.errors import InternalError, PlugPilotError
from server.jobs import sequence
from server.jobs.context import JobContext
from server.jobs.errors import (
    IdempotencyReuseError,
    JobEndedError,
    JobInterruptedError,
    JobNotFoundError,
    JobRunningError,
    NotChargingError,
    PlugStateError,
    UnknownVehicleError,
    VehicleChoiceError,
)
from server.jobs.journal import Journal
from server.jobs.model import JobPhase, JobState, JobType
from server.localisation.eye import Eye
from server.localisation.socket_pose import SocketPose
from server.schema.jobs import Job, JobRequest, JobResult
from server.schema.vehicles import Vehicle
from server.storage.jobs import JobStore
from server.storage.vehicles import VehicleStore
from server.timing import Calendar

_log = logging.getLogger(__name__)

CAN_BE_MADE_READY = {RobotMode.OFF, RobotMode.NOT_HOMED, RobotMode.READY}

PAST_CANCELLING = {JobPhase.RELEASING, JobPhase.WITHDRAWING, JobPhase.PARKING}
"""The job is on its way back already: cancelling changes nothing."""


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
        self._accepting = asyncio.Lock()
        self._context: JobContext | None = None
        self._task: asyncio.Task[None] | None = None
        self._work: asyncio.Task[None] | None = None

    def listen(self, listener: Callable[[], None]) -> None:
        """Call ``listener`` after every change of the newest job or the socket's pose."""
        self._listeners.append(listener)

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
            with contextlib.suppress(asyncio.CancelledError):
                await self._task

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
                    return _repeated(known, digest)
            vehicle = await self._choose_vehicle(request.vehicle_id)
            self._refuse_if_busy()
            self._refuse_if_impossible(request.type)
            lease = self._supervisor.acquire("job", _TITLES[request.type])
            try:
                return await self._accept(request, vehicle, lease, key, digest)
            except BaseException:
                self._supervisor.give_back(lease)
                raise

    async def cancel(self, job_id: str) -> Job:
        """Ask a job to stop and go back to safety; harmless when it is on its way back.

        Raises:
            JobNotFoundError: no such job.
            JobEndedError: it has ended.
        """
        context = await self._running(job_id)
        journal = context.journal
        if not journal.job.cancel_requested:
            await journal.want_cancel()
            if journal.job.phase not in PAST_CANCELLING and self._work is not None:
                self._work.cancel()
        return journal.job

    async def finish(self, job_id: str) -> Job:
        """End the charging now; the job goes on to unplug.

        Raises:
            JobNotFoundError, JobEndedError: as in ``cancel``.
            NotChargingError: it is not charging.
        """
        context = await self._running(job_id)
        job = context.journal.job
        if job.phase is not JobPhase.CHARGING:
            raise NotChargingError(f"The job is in the phase {job.phase.value}.")
        context.finish.set()
        return job

    async def wait(self) -> None:
        """Wait until the running job has ended."""
        if self._task is not None:
            await asyncio.shield(self._task)

    async def _accept(
        self,
        request: JobRequest,
        vehicle: Vehicle,
        lease: Lease,
        key: str | None,
        digest: str | None,
    ) -> Job:
        now = self._calendar.now()
        job = Job(
            id=str(uuid7()),
            type=request.type,
            state=JobState.QUEUED,
            phase=JobPhase.PREFLIGHT,
            vehicle_id=vehicle.id,
            target_energy_wh=request.target_energy_wh,
            created_at=now,
            updated_at=now,
            phase_started_at=now,
            cancel_requested=False,
            result=JobResult(),
            error=None,
        )
        await self._jobs.add(job, key=key, digest=digest)
        context = JobContext(
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
        self._context = context
        self._job_changed(job)
        self._task = asyncio.create_task(self._run(context), name=f"job {job.id}")
        return job

    async def _run(self, context: JobContext) -> None:
        journal = context.journal
        try:
            self._work = asyncio.create_task(sequence.carry_out(context), name="job phases")
            state, error = await self._outcome(context, self._work)
            if state is not JobState.SUCCEEDED:
                await sequence.retreat(context, error)
            await journal.end(state, error.detail if error else _ENDINGS[state], error)
        finally:
            self._supervisor.give_back(context.lease)
            self._context = None
            self._changed()

    async def _outcome(
        self, context: JobContext, work: asyncio.Task[None]
    ) -> tuple[JobState, PlugPilotError | None]:
        """How the phases ended."""
        try:
            await work
        except PlugPilotError as error:
            return JobState.FAILED, error
        except asyncio.CancelledError:
            if work.cancelled() and context.journal.job.cancel_requested:
                return JobState.CANCELLED, None
            # PlugPilot itself is stopping.
            work.cancel()
            await asyncio.gather(work, return_exceptions=True)
            raise
        except Exception as error:  # noqa: BLE001 - whatever it is, the job must end with a reason
            _log.exception("a phase failed in a way nobody thought of")
            return JobState.FAILED, InternalError(f"{type(error).__name__}: {error}")
        return JobState.SUCCEEDED, None

    async def _running(self, job_id: str) -> JobContext:
        if self._context is not None and self._context.journal.job.id == job_id:
            return self._context
        job = await self._jobs.get(job_id)
        if job is None:
            raise JobNotFoundError(f"There is no job {job_id}.", job_id=job_id)
        raise JobEndedError(f"The job {job.state.value} already.", job_id=job_id)

    async def _choose_vehicle(self, vehicle_id: str | None) -> Vehicle:
        if vehicle_id is not None:
            vehicle = await self._vehicles.get(vehicle_id)
            if vehicle is None:
                raise UnknownVehicleError(
                    f"There is no vehicle {vehicle_id!r}.", vehicle_id=vehicle_id
                )
            return vehicle
        vehicles = await self._vehicles.all()
        if not vehicles:
            raise UnknownVehicleError("No vehicle has been added yet.")
        if len(vehicles) > 1:
            names = ", ".join(vehicle.id for vehicle in vehicles)
            raise VehicleChoiceError(f"Several vehicles are known: {names}.")
        return vehicles[0]

    def _refuse_if_busy(self) -> None:
        if self._context is not None:
            running = self._context.journal.job
            raise JobRunningError(
                f"{_TITLES[running.type]} is in the phase {running.phase.value}.",
                job_id=running.id,
            )

    def _refuse_if_impossible(self, job_type: JobType) -> None:
        mode = self._supervisor.mode
        if mode not in CAN_BE_MADE_READY:
            problem = why_not_moving(mode, self._supervisor.telemetry.latest)
            if problem is not None:
                raise problem
        plug = self._supervisor.plug.state
        if job_type is JobType.UNPLUG:
            if plug in {PlugState.PARKED, PlugState.FREE}:
                raise PlugStateError("The plug is not in a car.", plug=plug.value)
        elif plug is PlugState.INSERTED:
            raise PlugStateError("The plug is still in the car.", plug=plug.value)
        elif plug is PlugState.UNKNOWN:
            raise PlugStateError(
                "PlugPilot does not know whether the plug is in the car.", plug=plug.value
            )

    def _job_changed(self, job: Job) -> None:
        self.newest = job
        self._changed()

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

_ENDINGS = {
    JobState.SUCCEEDED: "Done.",
    JobState.CANCELLED: "Cancelled; the robot is back.",
}


def _repeated(known: tuple[Job, str | None], digest: str | None) -> Job:
    job, known_digest = known
    if known_digest != digest:
        raise IdempotencyReuseError(
            "A request with this Idempotency-Key and another content was accepted before.",
            job_id=job.id,
        )
    return job
