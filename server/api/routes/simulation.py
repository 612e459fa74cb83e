"""The simulated car; every request is refused before a real camera."""

from __future__ import annotations

from fastapi import APIRouter

from server.api.dependencies import ServicesDep
from server.api.errors import NotSimulatedError
from server.api.problems import problem_responses
from server.schema.simulation import CarCommand, SimulatedCarNow
from server.services import Services
from server.simulated_car import SimulatedCar

router = APIRouter(prefix="/simulation", tags=["simulation"])


def _car(services: Services) -> SimulatedCar:
    if services.simulated_car is None:
        raise NotSimulatedError("The camera is a real one.")
    return services.simulated_car


@router.get(
    "/car",
    operation_id="getSimulatedCar",
    summary="Read the simulated car",
    responses=problem_responses(409),
)
async def get_car(services: ServicesDep) -> SimulatedCarNow:
    """Where the simulated car really is."""
    return _car(services).now


@router.post(
    "/car",
    operation_id="commandSimulatedCar",
    summary="Drive the simulated car",
    responses=problem_responses(409, 422),
)
async def command_car(command: CarCommand, services: ServicesDep) -> SimulatedCarNow:
    """Let the simulated car drive in, on, stop or leave; answers at once."""
    return _car(services).carry_out(command)
