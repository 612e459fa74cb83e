"""What everyone may see of calibration."""

from __future__ import annotations

from server.calibration.routines.desk import RoutineDesk
from server.calibration.versions.service import Calibrations
from server.schema.calibrations import CalibrationsInForce
from server.schema.routines import CalibrationNow


def calibration_view(calibrations: Calibrations, routines: RoutineDesk) -> CalibrationNow:
    """What counts, and what is being measured."""
    versions = {kind.value: one for kind, one in calibrations.versions_in_force.items()}
    return CalibrationNow(
        in_force=CalibrationsInForce.model_validate(versions), routine=routines.shown
    )
