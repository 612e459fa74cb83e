"""Lets commands through only for whoever is in control of the robot."""

from __future__ import annotations

from fastapi.requests import HTTPConnection
from fastapi.routing import APIRoute

from server.access import Caller
from server.access.operations import COMMANDS, JOB_COMMANDS
from server.api.dependencies import ServicesDep
from server.api.gate import caller_of
from server.control.seat import Operator
from server.services import Services


def operator_of(caller: Caller) -> Operator | None:
    """The person who makes a request; None: a program does."""
    person = caller.person
    return None if person is None else Operator(person.id, person.name, person.role.value)


def admit_command(services: Services, caller: Caller, operation: str) -> None:
    """Let an operation pass, and note who is in control from now on.

    Args:
        services: The running parts.
        caller: Who asks for it.
        operation: Its name in the table; what commands nothing passes.

    Raises:
        ControlHeldError: somebody else is in control.
    """
    if operation in COMMANDS:
        by_hand = operation not in JOB_COMMANDS
        services.seat.command(operator_of(caller), by_hand=by_hand)


async def commanding(connection: HTTPConnection, services: ServicesDep) -> None:
    """The same for every request, as a dependency of all routes."""
    route = connection.scope.get("route")
    if isinstance(route, APIRoute) and route.operation_id is not None:
        admit_command(services, caller_of(connection), route.operation_id)
