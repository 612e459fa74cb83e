"""Health of the service; needs no account and tells nothing private."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from server.schema.base import Wire


class ComponentHealth(Wire):
    """One part of the service."""

    status: Literal["ok", "degraded", "down"]
    detail: str = Field(description="In words")


class Health(Wire):
    """Whether the service works, part by part."""

    status: Literal["ok", "degraded", "down"] = Field(description="The worst of its parts")
    version: str
    uptime_s: float
    components: dict[Literal["robot", "camera", "station", "storage", "twin"], ComponentHealth]
