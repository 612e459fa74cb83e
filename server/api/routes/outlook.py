"""When the running job reaches what people wait for."""

from __future__ import annotations

from fastapi import APIRouter

from server.api.dependencies import ServicesDep
from server.schema.outlook import Outlook

router = APIRouter(prefix="/outlook", tags=["jobs"])


@router.get("", operation_id="getOutlook", summary="Read the time left")
async def get_outlook(services: ServicesDep) -> Outlook | None:
    """The running job's next milestone; null when nothing can be told of it.

    The section `outlook` of the WebSocket is the same, sent again only when it has moved.
    """
    return services.outlook.now()
