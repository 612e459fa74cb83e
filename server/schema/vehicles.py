"""Vehicles as the API shows them."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from server.schema.base import READABLE, VehicleId, Wire

Offset = Annotated[float, Field(ge=-500, le=500, allow_inf_nan=False)]
SmallAngle = Annotated[float, Field(ge=-0.6, le=0.6, allow_inf_nan=False)]


class SocketOffset(Wire):
    """Where the socket sits relative to the label (label frame: x right, y down, z into the car).

    The origin is the centre of the socket's face. The angles turn the label's z axis onto the
    socket's axis: first about the label's x, then about its y.
    """

    x_mm: Offset = 120.0
    y_mm: Offset = 0.0
    z_mm: Offset = 0.0
    rotation_x_rad: SmallAngle = 0.0
    rotation_y_rad: SmallAngle = 0.0


class VehicleSettings(Wire):
    """What the owner says about a vehicle."""

    name: Annotated[
        str, Field(min_length=1, max_length=80, pattern=READABLE, examples=["Renault Zoe"])
    ]
    label_size_mm: Annotated[
        float,
        Field(ge=20, le=200, allow_inf_nan=False, description="Side of the code, quiet zone apart"),
    ] = 60.0
    socket: SocketOffset = SocketOffset()
    driver_faces: Literal["robot", "away"] | None = Field(
        default=None,
        description="This car comes in nose first (robot) or backwards (away); "
        "null: as `guidance.driver_faces` says",
    )


class Vehicle(VehicleSettings):
    """A vehicle that the robot knows."""

    id: VehicleId
    name: str = Field(max_length=80)  # as it is stored, whenever that was
    label_payload: str = Field(description="Text in its QR label", examples=["PP2:zoe:4NG43RRFJW"])


class VehicleList(Wire):
    """Vehicles, by name."""

    items: list[Vehicle]
    next_cursor: str | None = Field(
        default=None, description="Pass as ?cursor= for the next page; null: end"
    )
