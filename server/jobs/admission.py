"""Whether a request may become a job, and whose car it is about."""

from __future__ import annotations

from server.control.model import PlugState, RobotMode
from server.control.modes import why_not_moving
from server.control.supervisor import Supervisor
from server.jobs.errors import (
    IdempotencyReuseError,
    PlugStateError,
    UnknownVehicleError,
    VehicleChoiceError,
)
from server.jobs.model import JobType
from server.schema.jobs import Job, JobRequest
from server.schema.vehicles import Vehicle
from server.storage.vehicles import VehicleStore

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
    vehicle of the newest job, even if that has been forgotten since.

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
    if not known:
        raise UnknownVehicleError("No vehicle has been added yet.")
    if len(known) > 1:
        names = ", ".join(vehicle.id for vehicle in known)
        raise VehicleChoiceError(f"Several vehicles are known: {names}.")
    return known[0].id, known[0]


def refuse_if_impossible(job_type: JobType, supervisor: Supervisor) -> None:
    """Refuse what the robot's mode or the plug's place rules out.

    Raises:
        ControlError: the robot cannot move, and the job could not change that.
        PlugStateError: the plug is not where the job needs it.
    """
    mode = supervisor.mode
    if mode not in CAN_BE_MADE_READY:
        problem = why_not_moving(mode, supervisor.telemetry.latest)
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
