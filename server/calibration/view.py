"""What everyone may see of calibration."""

from __future__ import annotations

from server.calibration.routines.desk import RoutineDesk
from server.calibration.versions.service import Calibrations
from server.schema.calibrations import CalibrationKind, CalibrationsInForce
from server.schema.routines import CalibrationNow


def calibration_view(calibrations: Calibrations, routines: RoutineDesk) -> CalibrationNow:
    """What counts, and what is being measured."""
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
        routine=routines.shown,
    )
