"""Whether the service works."""

from __future__ import annotations

from fastapi import APIRouter

from server.api.dependencies import ServicesDep
from server.control.model import RobotMode
from server.schema.health import ComponentHealth, Health
from server.services import Services
from server.version import VERSION

router = APIRouter(tags=["service"])

_OK = ComponentHealth(status="ok", detail="Works.")


@router.get("/health", operation_id="getHealth", summary="Read the health of every part")
async def health(services: ServicesDep) -> Health:
    """Health of every part. Answers 200 as long as the service itself runs."""
    components = {
        "robot": _robot(services),
        "camera": _OK
        if services.camera.online
        else ComponentHealth(status="down", detail="The camera does not deliver pictures."),
        "station": _OK
        if services.station.online
        else ComponentHealth(status="down", detail="The charging station does not answer."),
        "storage": _OK,
        "twin": _twin(services),
    }
    statuses = {component.status for component in components.values()}
    worst = next((s for s in ("down", "degraded") if s in statuses), "ok")
    now = services.calendar.now()
    return Health.model_validate(
        {
            "status": "degraded" if worst == "down" else worst,
            "version": VERSION,
            "uptime_s": round((now - services.started_at).total_seconds(), 1),
            "components": components,
        }
    )


def _robot(services: Services) -> ComponentHealth:
    match services.supervisor.mode:
        case RobotMode.OFFLINE:
            return ComponentHealth(status="down", detail="The motion board does not answer.")
        case RobotMode.FAULT | RobotMode.EMERGENCY_STOP:
            return ComponentHealth(status="degraded", detail="Stopped; needs a person.")
        case _:
            return _OK


def _twin(services: Services) -> ComponentHealth:
    if services.twin is not None and services.twin.ready:
        return _OK
    return ComponentHealth(status="degraded", detail="The 3D picture is still being built.")
