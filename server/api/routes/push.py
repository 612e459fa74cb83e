"""Notifications of one's own browser."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response

from server.api.dependencies import ServicesDep
from server.api.gate import caller_of
from server.api.problems import problem_responses
from server.schema.push import PushState, PushSubscription

router = APIRouter(prefix="/push", tags=["access"])


@router.get(
    "",
    operation_id="getPush",
    summary="Read whether this browser is notified",
    responses=problem_responses(503),
)
async def get_push(request: Request, services: ServicesDep) -> PushState:
    """The robot's key at push services, and whether this device is told what happens."""
    return await services.push.state(caller_of(request).id)


@router.put(
    "",
    status_code=204,
    response_class=Response,
    operation_id="subscribePush",
    summary="Notify this browser",
    responses=problem_responses(422, 503),
)
async def subscribe_push(wanted: PushSubscription, request: Request, services: ServicesDep) -> None:
    """Tell this device when a job ends, fails or needs a person, until it is removed."""
    await services.push.subscribe(caller_of(request).id, wanted)


@router.delete(
    "",
    status_code=204,
    response_class=Response,
    operation_id="unsubscribePush",
    summary="Do not notify this browser",
    responses=problem_responses(503),
)
async def unsubscribe_push(request: Request, services: ServicesDep) -> None:
    """Tell this device nothing any more."""
    await services.push.unsubscribe(caller_of(request).id)
