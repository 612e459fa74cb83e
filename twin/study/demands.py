"""What a robot must be able to do, and how far its lengths may be varied to get there."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from twin.geometry import PositiveLength, SignedLength
from twin.kinematics.singularity import SingularityLimits
from twin.statics import ActuatorLimits, Loads

NotNegative = Annotated[float, Field(ge=0, le=1000, allow_inf_nan=False)]


class Frozen(BaseModel):
    """Base of the models here: immutable, and a misspelt name is an error."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class Demand(StrEnum):
    """What can stand in the way of a design."""

    LEG_LENGTH = "leg_length"
    ABOVE_CARRIAGES = "above_carriages"
    CONDITION = "condition"
    CARRIAGE_FORCE = "carriage_force"
    PARALLEL = "parallel"
    SERIAL = "serial"
    PARALLELOGRAM = "parallelogram"
    BASE_WIDTH = "base_width"
    STROKE = "stroke"
    SLIDE_TRAVEL = "slide_travel"
    SLIDE_FORCE = "slide_force"


class Demands(Frozen):
    """The box that the plug tip must serve, and what must hold in every point of it.

    The box is the paper's. The margin is this project's own: room for the errors of the build and
    for homing. At a condition number of 3 an error of the carriages grows at most threefold more
    in one direction than in the other.
    """

    width_mm: PositiveLength = Field(200.0, description="of the box, along the rail")
    height_mm: PositiveLength = Field(200.0, description="of the box, away from the rail")
    depth_mm: PositiveLength = Field(20.0, description="of the box, out of the wall")
    margin_mm: NotNegative = Field(10.0, description="stroke left at both ends of each carriage")
    insertion_travel_mm: NotNegative = Field(
        60.0, description="travel of the slide beside the box: 20 mm before the socket, 40 mm deep"
    )
    max_condition: float = Field(
        3.0, ge=1, le=1e6, description="of the Jacobian of the parallel robot"
    )
    loads: Loads = Loads()
    limits: ActuatorLimits = ActuatorLimits()
    singularity: SingularityLimits = SingularityLimits()


class Bounds(Frozen):
    """Least and greatest value of a length [mm]; equal ones fix it."""

    low_mm: SignedLength
    high_mm: SignedLength

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        if self.high_mm < self.low_mm:
            msg = f"the upper bound ({self.high_mm:g}) must not be less than the lower one"
            msg += f" ({self.low_mm:g})"
            raise ValueError(msg)
        return self


class SearchBounds(Frozen):
    """How far each length may be varied; the defaults are this project's own.

    The narrowest platform leaves room for the plug holder. L2 and the strokes are not searched:
    they follow from the other lengths as the least that hold the box, and have a greatest value.
    """

    leg_length_mm: Bounds = Bounds(low_mm=250, high_mm=800)
    platform_width_mm: Bounds = Bounds(low_mm=120, high_mm=240)
    e1x_mm: Bounds = Bounds(low_mm=-50, high_mm=50)
    e2x_mm: Bounds = Bounds(low_mm=-50, high_mm=50)
    box_center_y_mm: Bounds = Bounds(low_mm=50, high_mm=800)
    base_width_max_mm: PositiveLength = 2000.0
    stroke_max_mm: PositiveLength = 1500.0

    @property
    def searched(self) -> tuple[Bounds, ...]:
        """Bounds of the variables of the search, in the order of `SEARCHED`."""
        return tuple(getattr(self, name) for name in SEARCHED)


SEARCHED = ("leg_length_mm", "platform_width_mm", "e1x_mm", "e2x_mm", "box_center_y_mm")
"""The variables of the search."""
