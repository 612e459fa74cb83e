"""Vehicles."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Path, Response

from server.api.dependencies import ServicesDep
from server.api.errors import InvalidCursorError
from server.api.etags import (
    ETAG_HEADER,
    VERSIONED,
    IfMatch,
    etag_of,
    refuse_mismatch,
    require_match,
)
from server.api.pagination import Cursor, Limit, split_page
from server.api.problems import problem_responses
from server.jobs.errors import UnknownVehicleError, VehicleInUseError
from server.schema.base import VehicleId
from server.schema.vehicles import Vehicle, VehicleList, VehicleSettings
from server.services import Services

router = APIRouter(prefix="/vehicles", tags=["vehicles"])

IdInPath = Annotated[VehicleId, Path()]


@router.get(
    "", operation_id="listVehicles", summary="List vehicles", responses=problem_responses(400)
)
async def list_vehicles(
    services: ServicesDep, cursor: Cursor = None, limit: Limit = 100
) -> VehicleList:
    """Vehicles, by name."""
    vehicles = await services.vehicles.all()
    begin = 0
    if cursor is not None:
        ids = [vehicle.id for vehicle in vehicles]
        if cursor not in ids:
            raise InvalidCursorError(f"{cursor!r} is not a cursor of this list.")
        begin = ids.index(cursor) + 1
    page, last = split_page(vehicles[begin:], limit)
    return VehicleList(items=page, next_cursor=last.id if last else None)


@router.get(
    "/{vehicle_id}",
    operation_id="getVehicle",
    summary="Read a vehicle",
    responses={**VERSIONED, **problem_responses(404, 422)},
)
async def get_vehicle(vehicle_id: IdInPath, response: Response, services: ServicesDep) -> Vehicle:
    """One vehicle."""
    vehicle = await services.vehicles.get(vehicle_id)
    if vehicle is None:
        raise UnknownVehicleError(f"There is no vehicle {vehicle_id!r}.", vehicle_id=vehicle_id)
    response.headers["ETag"] = etag_of(vehicle)
    return vehicle


@router.put(
    "/{vehicle_id}",
    operation_id="putVehicle",
    summary="Add or change a vehicle",
    responses={
        **VERSIONED,
        201: {"model": Vehicle, "description": "Added", "headers": ETAG_HEADER},
        **problem_responses(409, 412, 422, 428, 503),
    },
)
async def put_vehicle(
    vehicle_id: IdInPath,
    settings: VehicleSettings,
    response: Response,
    services: ServicesDep,
    if_match: IfMatch = None,
) -> Vehicle:
    """To change one, send its ETag as If-Match; to add one, leave that out."""
    _refuse_in_use(services, vehicle_id)
    async with services.vehicles.changing:
        known = await services.vehicles.get(vehicle_id)
        if known is None:
            refuse_mismatch(if_match, None)
        else:
            require_match(if_match, known)
        vehicle, is_new = await services.vehicles.put(vehicle_id, settings)
    if is_new:
        response.status_code = 201
    response.headers["ETag"] = etag_of(vehicle)
    return vehicle


@router.delete(
    "/{vehicle_id}",
    status_code=204,
    response_class=Response,
    operation_id="deleteVehicle",
    summary="Forget a vehicle",
    responses=problem_responses(404, 409, 412, 422, 503),
)
async def delete_vehicle(
    vehicle_id: IdInPath, services: ServicesDep, if_match: IfMatch = None
) -> None:
    """Its jobs stay in the history."""
    _refuse_in_use(services, vehicle_id)
    async with services.vehicles.changing:
        refuse_mismatch(if_match, await services.vehicles.get(vehicle_id))
        is_gone = await services.vehicles.delete(vehicle_id)
    if not is_gone:
        raise UnknownVehicleError(f"There is no vehicle {vehicle_id!r}.", vehicle_id=vehicle_id)


def _refuse_in_use(services: Services, vehicle_id: str) -> None:
    job = services.runner.newest
    if job is not None and not job.state.ended and job.vehicle_id == vehicle_id:
        raise VehicleInUseError(f"A job with {vehicle_id!r} is running.", job_id=job.id)
