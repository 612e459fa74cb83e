"""The simulated car, and the hand with the board; refused before a real camera."""

from __future__ import annotations

from fastapi import APIRouter

from server.api.dependencies import ServicesDep
from server.api.errors import NotSimulatedError
from server.api.problems import problem_responses
from server.schema.simulation import (
    BoardCommand,
    CarCommand,
    SimulatedBoardNow,
    SimulatedCarNow,
)
from server.services import Services
from server.simulated_car import SimulatedCar
from server.simulated_hand import SimulatedHand

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


def _hand(services: Services) -> SimulatedHand:
    if services.simulated_hand is None:
        raise NotSimulatedError("The camera is a real one.")
    return services.simulated_hand


@router.get(
    "/board",
    operation_id="getSimulatedBoard",
    summary="Read the simulated board",
    responses=problem_responses(409),
)
async def get_board(services: ServicesDep) -> SimulatedBoardNow:
    """Where a simulated hand holds the calibration board."""
    return _hand(services).now


@router.post(
    "/board",
    operation_id="commandSimulatedBoard",
    summary="Hold the simulated board",
    responses=problem_responses(409, 422),
)
async def command_board(command: BoardCommand, services: ServicesDep) -> SimulatedBoardNow:
    """Hold the calibration board before the simulated camera, or take it away; answers at once."""
    return _hand(services).carry_out(command)
