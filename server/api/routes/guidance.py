"""Parking guidance."""

from __future__ import annotations

from fastapi import APIRouter

from server.api.dependencies import ServicesDep
from server.guidance.view import guidance_view
from server.schema.guidance import Guidance

router = APIRouter(prefix="/guidance", tags=["guidance"])


@router.get("", operation_id="getGuidance", summary="Read the parking guidance")
async def get_guidance(services: ServicesDep) -> Guidance:
    """What the driver of an arriving car is told now.

    The camera looks only while somebody watches or asks: the first answer may know of no car yet.
    Ask again every second, or watch the section ``guidance`` of the WebSocket.
    """
    services.guide.ask()
    return guidance_view(services.guide, services.settings, services.calendar)
