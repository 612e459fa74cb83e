"""Which routine a request asks for."""

from __future__ import annotations

from server.calibration.routines.belts_routine import BeltsRoutine
from server.calibration.routines.camera_routine import CameraRoutine
from server.calibration.routines.check_routine import CheckRoutine
from server.calibration.routines.force_routine import ForceRoutine
from server.calibration.routines.play_routine import PlayRoutine
from server.calibration.routines.robot_routine import RobotRoutine
from server.calibration.routines.routine import AnyRoutine
from server.calibration.routines.socket_routine import SocketRoutine
from server.calibration.routines.switches_routine import SwitchesRoutine
from server.jobs.errors import UnknownVehicleError, VehicleChoiceError
from server.schema.routines import (
    BeltsRoutineRequest,
    CameraRoutineRequest,
    CheckRoutineRequest,
    ForceRoutineRequest,
    PlayRoutineRequest,
    RobotRoutineRequest,
    RoutineRequest,
    SocketRoutineRequest,
)
from server.schema.vehicles import Vehicle
from server.storage.vehicles import VehicleStore


async def routine_for(request: RoutineRequest, by: str, vehicles: VehicleStore) -> AnyRoutine:
    """A routine that was not yet begun.

    Raises:
        UnknownVehicleError, VehicleChoiceError: it is not clear whose label to look at.
    """
    if isinstance(request, BeltsRoutineRequest):
        return BeltsRoutine(request, by)
    if isinstance(request, ForceRoutineRequest):
        return ForceRoutine(request, by)
    if isinstance(request, CameraRoutineRequest):
        return CameraRoutine(request, by)
    vehicle = await _chosen(request.vehicle_id, vehicles)
    if isinstance(request, RobotRoutineRequest):
        return RobotRoutine(request, by, vehicle)
    if isinstance(request, SocketRoutineRequest):
        return SocketRoutine(request, by, vehicle)
    if isinstance(request, CheckRoutineRequest):
        return CheckRoutine(request, by, vehicle)
    if isinstance(request, PlayRoutineRequest):
        return PlayRoutine(request, by, vehicle)
    return SwitchesRoutine(request, by, vehicle)


async def _chosen(vehicle_id: str | None, vehicles: VehicleStore) -> Vehicle:
    known = await vehicles.all()
    if vehicle_id is not None:
        for vehicle in known:
            if vehicle.id == vehicle_id:
                return vehicle
        raise UnknownVehicleError(f"There is no vehicle {vehicle_id!r}.")
    if not known:
        raise UnknownVehicleError("No vehicle has been added yet.")
    if len(known) > 1:
        names = ", ".join(vehicle.id for vehicle in known)
        raise VehicleChoiceError(f"Several vehicles are known: {names}.")
    return known[0]
