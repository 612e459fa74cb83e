"""Where the robot and the model beside it have parted, as the API shows it."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from server.schema.base import Timestamp, Wire
from server.schema.robot import Joints
from twin.divergence import Quantity


class DivergenceReport(Wire):
    """One quantity that differs from the model by more than both are uncertain."""

    quantity: Quantity
    title: str = Field(description="Short, the same for every occurrence of the quantity")
    message: str = Field(description="This occurrence, in a sentence")
    unit: Literal["mm", "N", "s"] = Field(description="Of expected, measured and sigma")
    expected: float
    measured: float
    sigma: float = Field(gt=0, description="Standard deviation of the difference if all is well")
    sigmas: float = Field(ge=0, description="Size of the difference in standard deviations")
    at: Timestamp
    phase: str = Field(description="Of the job; empty without one")
    joints: Joints = Field(description="Measured at that moment")
    depth_mm: float | None = Field(description="Plug in the socket; null while it is not known")
    tip_off_mm: float | None = Field(
        description="How far the plug's tip is from where the model has it; null where that says "
        "nothing"
    )


class TwinReport(Wire):
    """What the model beside the robot finds."""

    divergences: list[DivergenceReport] = Field(
        default_factory=list, description="Empty while robot and model agree"
    )
