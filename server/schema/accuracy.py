"""Nine-point checks as the API shows them."""

from __future__ import annotations

from pydantic import Field

from server.calibration.grade import Grade
from server.schema.base import Timestamp, Wire


class CheckedPlace(Wire):
    """One place of the check, in the terms of ISO 9283."""

    x_mm: float = Field(description="Where the platform was sent")
    y_mm: float
    accuracy_mm: float = Field(ge=0, description="AP: how far the mean of all approaches is off")
    repeatability_mm: float = Field(ge=0, description="RP: mean distance from it plus 3 sigma")
    direction_variation_mm: float = Field(
        ge=0, description="vAP: between the means of the two directions, which is mostly play"
    )
    attained_mm: list[tuple[float, float]] = Field(
        description="Where it came to; first all from below, then as many from above"
    )


class AccuracyCheck(Wire):
    """A nine-point check. Places without a label in the picture are left out."""

    id: str
    made_at: Timestamp
    made_by: str
    calibration_id: str | None = Field(
        description="The calibration of the robot that was in force; null: as drawn"
    )
    approaches: int = Field(ge=3, description="Of each place from each of two directions")
    places: list[CheckedPlace]
    left_out: int = Field(ge=0, description="Places from which the label was not to be seen")
    accuracy_mm: float = Field(ge=0, description="The largest AP")
    repeatability_mm: float = Field(ge=0, description="The largest RP")
    direction_variation_mm: float = Field(ge=0, description="The largest vAP")
    duration_s: float = Field(ge=0, description="Robot time")
    verdict: Grade | None = Field(default=None, description="Is it exact enough for sockets?")
    remarks: list[str] = Field(
        default_factory=list, description="What keeps it from being better, with what to do"
    )


class AccuracyCheckPage(Wire):
    """Checks, newest first."""

    items: list[AccuracyCheck]
    next_cursor: str | None = Field(
        default=None, description="Pass as ?cursor= for the next page; null: end"
    )
