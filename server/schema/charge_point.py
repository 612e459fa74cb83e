"""The robot with its station as one charger: flat, for energy managers."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from drivers.station import PilotState
from server.schema.base import Timestamp, Wire

RobotActivity = Literal[
    "parked", "plugging", "plugged", "charging", "paused", "unplugging", "stopped", "fault"
]
RestReason = Literal["unplugged", "charged", "failed"]


class ChargePoint(Wire):
    """One charger. A car is connected (B) as soon as the robot could plug it in."""

    cp_state: PilotState = Field(
        description="As IEC 61851. A: nothing to charge; B: a car is plugged in or can be; "
        "C, D: it charges; E: the station does not answer; F: robot or station need a person"
    )
    enabled: bool = Field(description="What was asked for last; false while it rests")
    power_w: float = Field(description="Active power now")
    energy_kwh: float = Field(ge=0, description="All energy so far; it never counts backwards")
    currents_a: tuple[float, float, float] = Field(description="Of each phase")
    contactor_closed: bool
    connector_locked: bool | None = Field(description="Null where the station does not say")
    max_current_a: float | None = Field(description="What was asked for last; null: nothing yet")
    limits_current: bool = Field(description="The station obeys max_current_a")
    robot_state: RobotActivity
    resting: RestReason | None = Field(
        description="Why it reports A and takes no command until somebody resumes it"
    )
    updated_at: Timestamp | None = Field(description="When the station was read; null: never yet")


class Enablement(Wire):
    """Whether the car may charge."""

    enabled: bool


class CurrentLimit(Wire):
    """How much the car may draw."""

    max_current_a: Annotated[
        float, Field(ge=6, le=80, allow_inf_nan=False, description="For each phase")
    ]
