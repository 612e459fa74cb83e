"""A nine-point check as it is kept."""

from __future__ import annotations

from datetime import datetime

from uuid6 import uuid7

from server.calibration.accuracy.verdict import judge_places
from server.calibration.routines.check_routine import CheckResult
from server.schema.accuracy import AccuracyCheck


def check_of(found: CheckResult, made_at: datetime, calibration_id: str | None) -> AccuracyCheck:
    """The record of a check.

    Args:
        found: What it has found.
        made_at: When.
        calibration_id: Of the robot, in force meanwhile.
    """
    return AccuracyCheck(
        id=str(uuid7()),
        made_at=made_at,
        made_by=found.by,
        calibration_id=calibration_id,
        approaches=found.request.approaches,
        places=list(found.places),
        left_out=found.left_out,
        accuracy_mm=max(place.accuracy_mm for place in found.places),
        repeatability_mm=max(place.repeatability_mm for place in found.places),
        direction_variation_mm=max(place.direction_variation_mm for place in found.places),
        duration_s=found.duration_s,
    )


def with_verdict(check: AccuracyCheck) -> AccuracyCheck:
    """A check as it is shown, judged by what is asked for today."""
    grade, remarks = judge_places(check.places)
    return check.model_copy(update={"verdict": grade, "remarks": list(remarks)})
