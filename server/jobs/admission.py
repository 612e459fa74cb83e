"""Whether a request may become a job, and whose car it is about."""

from __future__ import annotations

from datetime import datetime

from uuid6 import uuid7

from server.control.errors import ControlBusyError
from server.control.model import PlugState, RobotMode
from server.control.supervisor import Supervisor
from server.jobs.errors import (
    IdempotencyReuseError,
    PlugStateError,
    UnknownVehicleError,
    VehicleChoiceError,
)
from server.jobs.model import JobPhase, JobState, JobType
from server.schema.jobs import Job, JobRequest, JobResult
from server.schema.vehicles import Vehicle
from server.storage.vehicles import VehicleStore

UNKNOWN_VEHICLE = "unknown"
"""Id in jobs that pull the plug out of nobody knows which vehicle."""

CAN_BE_MADE_READY = {RobotMode.OFF, RobotMode.NOT_HOMED, RobotMode.READY}


def repeated(known: tuple[Job, str | None], digest: str | None) -> Job:
    """The job that a repeated request means.

    Raises:
        IdempotencyReuseError: the key is the same, but the request is another one.
    """
    job, known_digest = known
    if known_digest != digest:
        raise IdempotencyReuseError(
            "A request with this Idempotency-Key and another content was accepted before.",
            job_id=job.id,
        )
    return job


async def choose_vehicle(
    request: JobRequest, vehicles: VehicleStore, newest: Job | None
) -> tuple[str, Vehicle | None]:
    """Id of the vehicle that a request is about, and what is known about it.

    Pulling the plug out needs to know nothing about the vehicle, so unplugging falls back on the
    vehicle of the newest job, even if that has been forgotten since, and without one on none.

    Raises:
        UnknownVehicleError: there is no such vehicle, or none at all.
        VehicleChoiceError: several vehicles, none chosen.
    """
    if request.vehicle_id is not None:
        vehicle = await vehicles.get(request.vehicle_id)
        if vehicle is None:
            raise UnknownVehicleError(
                f"There is no vehicle {request.vehicle_id!r}.", vehicle_id=request.vehicle_id
            )
        return vehicle.id, vehicle
    if request.type is JobType.UNPLUG and newest is not None:
        return newest.vehicle_id, await vehicles.get(newest.vehicle_id)
    known = await vehicles.all()
    if request.type is JobType.UNPLUG and len(known) != 1:
        return UNKNOWN_VEHICLE, None
    if not known:
        raise UnknownVehicleError("No vehicle has been added yet.")
    if len(known) > 1:
        names = ", ".join(vehicle.id for vehicle in known)
        raise VehicleChoiceError(f"Several vehicles are known: {names}.")
    return known[0].id, known[0]


async def require_vehicle(job: Job, vehicles: VehicleStore) -> Vehicle | None:
    """The vehicle of a job that begins later than it was accepted; None if it needs none.

    Raises:
        UnknownVehicleError: it has been forgotten meanwhile.
    """
    vehicle = await vehicles.get(job.vehicle_id)
    if vehicle is None and job.type is not JobType.UNPLUG:
        raise UnknownVehicleError(
            f"The vehicle {job.vehicle_id!r} is not known any more.", vehicle_id=job.vehicle_id
        )
    return vehicle


def queued(request: JobRequest, vehicle_id: str, now: datetime) -> Job:
    """A new job, as it is accepted."""
    return Job(
        id=str(uuid7()),
        type=request.type,
        state=JobState.QUEUED,
        phase=JobPhase.PREFLIGHT,
        vehicle_id=vehicle_id,
        target_energy_wh=request.target_energy_wh,
        not_before=request.not_before,
        unplug_by=request.unplug_by,
        created_at=now,
        updated_at=now,
        phase_started_at=now,
        cancel_requested=False,
        result=JobResult(),
        error=None,
    )


def refuse_if_impossible(job_type: JobType, supervisor: Supervisor) -> None:
    """Refuse what the robot's mode or the plug's place rules out.

    Raises:
        ControlBusyError: a person commands the robot by hand.
        ControlError: the robot cannot move, and the job could not change that.
        PlugStateError: the plug is not where the job needs it.
    """
    person = supervisor.reserved_for
    if person is not None:
        raise ControlBusyError(f"{person} is in control of the robot.", holder=person)
    mode = supervisor.mode
    if mode not in CAN_BE_MADE_READY:
        problem = supervisor.why_not_moving()
        if problem is not None:
            raise problem
    plug = supervisor.plug.state
    if job_type is JobType.UNPLUG:
        if plug in {PlugState.PARKED, PlugState.FREE}:
            raise PlugStateError("The plug is not in a car.", plug=plug.value)
    elif plug is PlugState.INSERTED:
        raise PlugStateError("The plug is still in the car.", plug=plug.value)
    elif plug is PlugState.UNKNOWN:
        raise PlugStateError(
            "PlugPilot does not know whether the plug is in the car.", plug=plug.value
        )
