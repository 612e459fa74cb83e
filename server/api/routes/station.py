"""The charging station."""

from __future__ import annotations

from fastapi import APIRouter

from server.api.dependencies import ServicesDep
from server.live.views import station_view
from server.schema.station import Station

router = APIRouter(prefix="/station", tags=["station"])


@router.get("", operation_id="getStation", summary="Read the charging station")
async def get_station(services: ServicesDep) -> Station:
    """Newest reading of the charging station."""
    watch = services.station
    return station_view(watch.name, watch.snapshot, online=watch.online, calendar=services.calendar)
