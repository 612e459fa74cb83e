"""How patient the robot is with its jobs."""

from __future__ import annotations

from pydantic import Field

from server.config.section import Section


class JobSettings(Section):
    """When a job goes on by itself after a restart, and how early a car is unplugged."""

    max_resumptions: int = Field(
        3,
        ge=0,
        le=100,
        description="Restarts in the same phase after which the job asks a person",
    )
    max_outage_min: float = Field(
        720.0,
        ge=0,
        le=100_000,
        description="After a longer power cut no plug goes in before a person was asked",
    )
    unplug_lead_s: float = Field(
        90.0, ge=0, le=3600, description="Charging ends this long before the car is to be unplugged"
    )
