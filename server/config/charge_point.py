"""How an energy manager may use the robot as its charger."""

from __future__ import annotations

from pydantic import Field

from server.config.section import Section


class ChargePointSettings(Section):
    """The robot together with its station, as one charger: see server/charge_point."""

    vehicle_id: str | None = Field(
        None,
        min_length=1,
        max_length=64,
        description="Whom to plug in when it is enabled; needed with several vehicles",
    )
    attempts: int = Field(
        2, ge=1, le=10, description="Jobs that may fail in a row; then a person must resume it"
    )
    unplug_after_disabled_min: float | None = Field(
        None,
        gt=0,
        le=100_000,
        description="Disabled for so long, the car is unplugged; without a number it stays plugged",
    )
