"""A place that somebody has pointed at, and the checked way there."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from server.schema.base import Wire
from server.schema.robot import Joints, Tip

Coordinate = Annotated[float, Field(ge=-10_000, le=10_000, allow_inf_nan=False)]


class TargetRequest(Wire):
    """Where the plug's tip shall be; how far it is out stays as it is."""

    x_mm: Coordinate
    y_mm: Coordinate
    speed_mm_s: Annotated[float, Field(ge=0.5, le=20, allow_inf_nan=False)] = 10.0


class ActuatorForce(Wire):
    """What one actuator carries at the worst place of the way."""

    joint: Literal["rho1", "rho2", "rho3"]
    force_n: float = Field(description="Positive along growing rho")
    limit_n: float = Field(gt=0)
    share: float = Field(ge=0, description="Of the limit, 1 on it")
    at_s: float = Field(ge=0, description="After the start")


class MoveTarget(Wire):
    """The way there, checked along its whole length. Nothing has moved.

    To go there send ``move_to`` with its id on the WebSocket for as long as a button is held. It
    is valid until the robot moves otherwise, or another target is chosen.
    """

    id: str
    tip: Tip
    joints: Joints = Field(description="Of the robot there")
    way: list[Tip] = Field(description="Of the plug's tip, evenly in time")
    distance_mm: float = Field(ge=0)
    duration_s: float = Field(ge=0)
    forces: list[ActuatorForce]
