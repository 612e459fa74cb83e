"""Vehicles."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Path, Response

from server.api.dependencies import ServicesDep
from server.api.problems import problem_responses
from server.jobs.errors import UnknownVehicleError, VehicleInUseError
from server.schema.base import VehicleId
from server.schema.vehicles import Vehicle, VehicleList, VehicleSettings
from server.services import Services

router = APIRouter(prefix="/vehicles", tags=["vehicles"])

IdInPath = Annotated[VehicleId, Path()]


@router.get("", operation_id="listVehicles")
async def list_vehicles(services: ServicesDep) -> VehicleList:
    """All vehicles, by name."""
    return VehicleList(items=await services.vehicles.all())


@router.get("/{vehicle_id}", operation_id="getVehicle", responses=problem_responses(404, 422))
async def get_vehicle(vehicle_id: IdInPath, services: ServicesDep) -> Vehicle:
    """One vehicle."""
    vehicle = await services.vehicles.get(vehicle_id)
    if vehicle is None:
        raise UnknownVehicleError(f"There is no vehicle {vehicle_id!r}.", vehicle_id=vehicle_id)
    return vehicle


@router.put(
    "/{vehicle_id}",
    operation_id="putVehicle",
    responses={201: {"model": Vehicle, "description": "Added"}, **problem_responses(409, 422)},
)
async def put_vehicle(
    vehicle_id: IdInPath, settings: VehicleSettings, response: Response, services: ServicesDep
) -> Vehicle:
    """Add or change a vehicle."""
    _refuse_in_use(services, vehicle_id)
    vehicle, is_new = await services.vehicles.put(vehicle_id, settings)
    if is_new:
        response.status_code = 201
    return vehicle


@router.delete(
    "/{vehicle_id}",
    status_code=204,
    operation_id="deleteVehicle",
    responses=problem_responses(404, 409, 422),
)
async def delete_vehicle(vehicle_id: IdInPath, services: ServicesDep) -> None:
    """Forget a vehicle. Its jobs stay in the history."""
    _refuse_in_use(services, vehicle_id)
    if not await services.vehicles.delete(vehicle_id):
        raise UnknownVehicleError(f"There is no vehicle {vehicle_id!r}.", vehicle_id=vehicle_id)


def _refuse_in_use(services: Services, vehicle_id: str) -> None:
    job = services.runner.newest
    if job is not None and not job.state.ended and job.vehicle_id == vehicle_id:
        raise VehicleInUseError(f"A job with {vehicle_id!r} is running.", job_id=job.id)
