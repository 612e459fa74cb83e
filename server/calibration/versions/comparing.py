"""By how much is one calibration worse than the one in force?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from server.calibration.robot.looks import LabelLook
from server.calibration.robot.verdict import mechanism_error_mm
from server.calibration.versions.values import rotation_matrix
from server.schema.calibrations import CalibrationKind, LookRecord, RobotEvidence, RobotValues
from twin.as_built import PlanarAsBuilt
from twin.geometry import RobotGeometry

TIE = {CalibrationKind.CAMERA: 0.01}
"""Differences that are chance: of two cameras that are both right, either may be ahead [px]."""


@dataclass(frozen=True, slots=True)
class Comparison:
    """Two calibrations on the same data.

    Attributes:
        kind: Of both.
        candidate: What the new one misses; None: it was never measured.
        in_force: What the other one misses; None: it cannot be told.
    """

    kind: CalibrationKind
    candidate: float | None
    in_force: float | None

    @property
    def warning(self) -> str | None:
        """What speaks against the candidate, in a sentence; None: nothing does."""
        unit = self.kind.unit
        if self.candidate is None:
            return "This calibration was never measured: nobody knows how far it is off."
        if self.in_force is None or self.candidate <= self.in_force + TIE.get(self.kind, 0.0):
            return None
        return (
            f"It misses by {self.candidate:.3f} {unit}, the one in force by "
            f"{self.in_force:.3f} {unit}: {self.candidate - self.in_force:.3f} {unit} more."
        )


def compared_on_looks(
    values: RobotValues,
    evidence: RobotEvidence,
    held_back_mm: float | None,
    in_force: PlanarAsBuilt | None,
    drawn: RobotGeometry,
) -> Comparison:
    """Compare a calibration of the robot with the mechanism in force, on the former's looks."""
    looks = [look_of(record) for record in evidence.looks]
    believed = in_force or PlanarAsBuilt.as_drawn(drawn)
    return Comparison(
        CalibrationKind.ROBOT,
        held_back_mm,
        mechanism_error_mm(believed, rotation_matrix(values.camera_rotation_rad), looks),
    )


def look_of(record: LookRecord) -> LabelLook:
    """A kept look as the solver takes it."""
    return LabelLook(
        np.array([record.rho1_mm, record.rho2_mm]),
        np.array(record.label_mm),
        np.array(record.covariance_mm2).reshape(3, 3),
    )


def records_of(
    looks: Sequence[LabelLook], residual_mm: NDArray[np.float64], weight: NDArray[np.float64]
) -> list[LookRecord]:
    """Looks as they are kept.

    Args:
        looks: Of one label.
        residual_mm: Seen less predicted, shape (n, 3) [mm].
        weight: Of each look, shape (n,).
    """
    return [
        LookRecord(
            rho1_mm=float(look.rho_mm[0]),
            rho2_mm=float(look.rho_mm[1]),
            label_mm=tuple(look.label_mm.tolist()),
            covariance_mm2=look.covariance_mm2.ravel().tolist(),
            residual_mm=tuple(off.tolist()),
            weight=float(share),
        )
        for look, off, share in zip(looks, residual_mm, weight, strict=True)
    ]
