"""Control of the robot: who has it, asking for it, giving it, keeping it."""

from __future__ import annotations

from fastapi import APIRouter, Request

from server.api.commanding import operator_of
from server.api.dependencies import ServicesDep
from server.api.gate import caller_of
from server.api.problems import problem_responses
from server.control.errors import PeopleOnlyError
from server.control.seat import Operator
from server.live.control_view import control_view
from server.schema.control import Control, ControlReply

router = APIRouter(prefix="/robot/control", tags=["robot"])


@router.get("", operation_id="getControl", summary="Read who is in control")
async def get_control(services: ServicesDep) -> Control:
    """Who is in control, and who asks for it."""
    return control_view(services.seat)


@router.post(
    "/request",
    operation_id="askForControl",
    summary="Ask for control",
    responses=problem_responses(403, 409),
)
async def ask_for_control(request: Request, services: ServicesDep) -> Control:
    """Take control if it is free; otherwise ask whoever has it, who has 30 s to answer."""
    services.seat.ask(_person(request))
    return control_view(services.seat)


@router.delete(
    "/request",
    operation_id="withdrawControlRequest",
    summary="Ask no more",
    responses=problem_responses(403),
)
async def withdraw_request(request: Request, services: ServicesDep) -> Control:
    """Withdraw one's own request; harmless when there is none."""
    services.seat.withdraw(_person(request))
    return control_view(services.seat)


@router.post(
    "/answer",
    operation_id="answerControlRequest",
    summary="Give control, or keep it",
    responses=problem_responses(403, 409),
)
async def answer_request(reply: ControlReply, request: Request, services: ServicesDep) -> Control:
    """Answer whoever asks for control.

    When it is given, a motion by hand ends first. A job or a calibration goes on, and whoever has
    asked looks after it from then on.
    """
    await services.seat.reply(_person(request), reply.request_id, give=reply.give)
    return control_view(services.seat)


@router.delete(
    "",
    operation_id="giveControlBack",
    summary="Give control back",
    responses=problem_responses(403, 409),
)
async def give_back(request: Request, services: ServicesDep) -> Control:
    """Be in control no more; whoever asks for it gets it."""
    await services.seat.leave(_person(request))
    return control_view(services.seat)


def _person(request: Request) -> Operator:
    operator = operator_of(caller_of(request))
    if operator is None:
        raise PeopleOnlyError("A program cannot take control, and cannot be asked for it.")
    return operator
