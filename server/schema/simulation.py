"""What the simulated car can be told; there is none before a real camera."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from server.schema.base import Wire

Way = Annotated[float, Field(ge=-2000, le=2000, allow_inf_nan=False)]


class DriveIn(Wire):
    """Come in from outside and stop at the place, or as near to it as the driver manages."""

    type: Literal["drive_in"] = "drive_in"
    from_mm: Annotated[
        float, Field(ge=100, le=6000, allow_inf_nan=False, description="How far before its place")
    ] = 3500.0
    right_mm: Way = Field(0.0, description="How far beside its way the socket is then")
    heading_deg: Annotated[float, Field(ge=-20, le=20, allow_inf_nan=False)] = Field(
        0.0, description="How the car is turned then, positive to the left"
    )
    past_mm: Way = Field(0.0, description="Stop beyond the place, or short of it if negative")
    aims_right_mm: Way = Field(0.0, description="The driver misjudges the place by so much")


class DriveOn(Wire):
    """Go on so far from where the car is, back if negative."""

    type: Literal["drive_on"] = "drive_on"
    forward_mm: Annotated[float, Field(ge=-4000, le=4000, allow_inf_nan=False)]
    steer_right_mm: Way | None = Field(
        None, description="Steer to a line so far beside the last one; null goes straight"
    )


class Brake(Wire):
    """Stop now."""

    type: Literal["brake"] = "brake"


class Leave(Wire):
    """Back out of the garage."""

    type: Literal["leave"] = "leave"


CarCommand = Annotated[DriveIn | DriveOn | Brake | Leave, Field(discriminator="type")]


class SimulatedCarNow(Wire):
    """Where the simulated car really is."""

    x_mm: float = Field(description="Of its socket in the base frame")
    y_mm: float
    z_mm: float
    speed_mm_s: float = Field(description="Forward")
    moving: bool


Tilt = Annotated[float, Field(ge=-60, le=60, allow_inf_nan=False)]
InPicture = Annotated[float, Field(ge=-1.2, le=1.2, allow_inf_nan=False)]


class HoldBoard(Wire):
    """Hold the calibration board before the camera; the hand goes there in a moment."""

    type: Literal["hold"] = "hold"
    right: InPicture = Field(0.0, description="Its middle in the picture: -1 left edge, 1 right")
    down: InPicture = Field(0.0, description="The same from the top to the bottom")
    distance_mm: Annotated[float, Field(ge=150, le=1500, allow_inf_nan=False)] = 380.0
    left_away_deg: Tilt = Field(0.0, description="Its left edge is tipped away from the camera")
    top_away_deg: Tilt = Field(0.0, description="Its upper edge is tipped away from the camera")
    turn_deg: Annotated[float, Field(ge=-180, le=180, allow_inf_nan=False)] = Field(
        0.0, description="In the plane of the picture, clockwise"
    )
    within_s: Annotated[float, Field(ge=0, le=10, allow_inf_nan=False)] = 0.7


class PutBoardAway(Wire):
    """Take the board away."""

    type: Literal["away"] = "away"


BoardCommand = Annotated[HoldBoard | PutBoardAway, Field(discriminator="type")]


class SimulatedBoardNow(Wire):
    """What the simulated hand does."""

    held: HoldBoard | None = Field(description="Where it holds the board, or brings it; null: away")
