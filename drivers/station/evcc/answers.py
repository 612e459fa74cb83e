"""What evcc answers."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, field_validator

from drivers.station.web import Answer

Mode = Literal["off", "now", "minpv", "pv"]
Reading = Annotated[float, Field(ge=-1e6, le=1e6)]


class LoadPoint(Answer):
    """One element of `loadpoints`, and the parts of it that are needed.

    Attributes:
        mode: What the user chose.
        enabled: It has enabled the station.
        connected: A car is connected.
        charging: The car charges.
        power_w: [W].
        currents_a: One for each phase [A]; None where the charger does not measure them.
        session_wh: Energy since the car was connected [Wh].
    """

    mode: Mode
    enabled: bool
    connected: bool
    charging: bool
    power_w: Reading = Field(alias="chargePower")
    currents_a: tuple[Reading, Reading, Reading] | None = Field(None, alias="chargeCurrents")
    session_wh: Annotated[float, Field(ge=0, le=1e6)] = Field(0.0, alias="sessionEnergy")

    @field_validator("session_wh", mode="before")
    @classmethod
    def _not_counted_yet(cls, value: object) -> object:
        return 0.0 if value is None else value


class State(Answer):
    """GET /api/state."""

    loadpoints: tuple[LoadPoint, ...]


class Saved(Answer):
    """What has to be restored.

    Attributes:
        mode: Mode before ours.
        held: A hold is in force, not only a stop.
    """

    mode: Mode
    held: bool
