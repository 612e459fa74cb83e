"""What a version rests on, as it is kept."""

from __future__ import annotations

from typing import Any

from server.schema.calibrations import CalibrationKind, CameraEvidence, RobotEvidence
from server.storage.calibrations import StoredCalibration


def as_kept(evidence: RobotEvidence | CameraEvidence | None) -> dict[str, Any] | None:
    """As it is stored."""
    return evidence.model_dump(mode="json") if evidence else None


def robot_evidence_of(stored: StoredCalibration) -> RobotEvidence | None:
    """What a version rests on; None: nothing is kept, or it is one of the camera."""
    if stored.evidence is None or stored.kind == CalibrationKind.CAMERA:
        return None
    return RobotEvidence.model_validate(stored.evidence)


def camera_evidence_of(stored: StoredCalibration) -> CameraEvidence | None:
    """What a version of the camera rests on; None: nothing is kept, or it is another one."""
    if stored.evidence is None or stored.kind != CalibrationKind.CAMERA:
        return None
    return CameraEvidence.model_validate(stored.evidence)
