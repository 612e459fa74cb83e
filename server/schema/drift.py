"""What jobs say of the calibration on their way, as the API shows it."""

from __future__ import annotations

from pydantic import Field

from server.schema.base import Wire


class MaintenanceHint(Wire):
    """Something wears, or has moved. Nothing is stopped by it."""

    code: str = Field(description="Stable", examples=["plug_heavy"])
    title: str = Field(description="Short, the same for every occurrence of the code")
    text: str = Field(description="This occurrence, and what to do, in sentences")
    vehicle_id: str | None = Field(description="Whose socket or label; null: the robot itself")


class BeltDrift(Wire):
    """How the belts have changed since the robot was last measured, from the looks of jobs."""

    jobs: int = Field(ge=0, description="That were learnt from since the robot was measured")
    left_percent: float = Field(description="Travel of the left belt against then")
    left_sigma_percent: float = Field(ge=0)
    right_percent: float
    right_sigma_percent: float = Field(ge=0)
    moved_mm: float = Field(
        ge=0, description="What that makes at the nine places of the regular box, at most"
    )
    proven_mm: float = Field(ge=0, description="Within that the last measurement is proven")
    exceeds: bool = Field(description="It has drifted further than was proven")
    at_bound: bool = Field(description="As far as may be learnt from jobs: measure the robot")
    refused_in_a_row: int = Field(ge=0, description="Jobs whose looks did not fit at all")


class InsertionBand(Wire):
    """What good insertions into one vehicle's socket feel like."""

    vehicle_id: str
    learnt_from: int = Field(ge=0, description="Good insertions")
    points: list[tuple[float, float, float]] = Field(
        description="(Depth in mm, smallest and largest force in N); empty until there are enough"
    )
    recent: list[tuple[float, float]] = Field(
        description="(Depth in mm, mean force in N) of the last insertions"
    )


class DriftReport(Wire):
    """Everything that jobs have taught."""

    belts: BeltDrift
    hints: list[MaintenanceHint]
    insertions: list[InsertionBand]
