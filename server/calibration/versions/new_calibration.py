"""A version before it is kept."""

from __future__ import annotations

from dataclasses import dataclass

from server.calibration.grade import Grade
from server.schema.calibrations import CalibrationValues, CameraEvidence, RobotEvidence


@dataclass(frozen=True, slots=True)
class NewCalibration:
    """What was found, by whom, and how good it is.

    Attributes:
        values: The numbers.
        made_by: Who.
        source: Where the numbers come from, in words.
        grade: Of its verdict.
        remarks: Of its verdict.
        error: What it misses on data held back; None: not measured.
        error_in_use: What the one in force missed on the same data.
        evidence: What it rests on.
    """

    values: CalibrationValues
    made_by: str
    source: str
    grade: Grade = Grade.USABLE
    remarks: tuple[str, ...] = ()
    error: float | None = None
    error_in_use: float | None = None
    evidence: RobotEvidence | CameraEvidence | None = None
