"""What everyone may see of calibration."""

from __future__ import annotations

from server.calibration.measuring import Measuring
from server.calibration.versions.service import Calibrations
from server.schema.calibrations import CalibrationKind, CalibrationsInForce
from server.schema.routines import CalibrationNow


def calibration_view(calibrations: Calibrations, measuring: Measuring) -> CalibrationNow:
    """What counts, what is being measured, and what jobs have shown."""
    drift = measuring.drift.report
    versions = calibrations.versions_in_force
    whole = {one.kind: one for one in versions if one.kind is not CalibrationKind.SOCKET}
    return CalibrationNow(
        in_force=CalibrationsInForce(
            camera=whole.get(CalibrationKind.CAMERA),
            robot=whole.get(CalibrationKind.ROBOT),
            sockets=[one for one in versions if one.kind is CalibrationKind.SOCKET],
            switches=whole.get(CalibrationKind.SWITCHES),
            play=whole.get(CalibrationKind.PLAY),
            force=whole.get(CalibrationKind.FORCE),
        ),
        routine=measuring.routines.shown,
        drift=drift.belts,
        hints=drift.hints,
    )
