"""The protocol console."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query

from server.api.dependencies import ServicesDep
from server.schema.console import ProtocolFrames

router = APIRouter(prefix="/robot/frames", tags=["robot"])

MOST = 1000


@router.get("", operation_id="readFrames", summary="Follow the link to the board")
async def read(
    services: ServicesDep,
    after: Annotated[
        int, Query(ge=0, le=2**53 - 1, description="``newest`` of the last answer")
    ] = 0,
    limit: Annotated[int, Query(ge=1, le=MOST)] = MOST,
) -> ProtocolFrames:
    """What went to and from the motion board since the last look; waits a second for news.

    Nothing is kept before somebody asks, nor when nobody has asked for some seconds.
    """
    return await services.technician.console.after(after, limit)
