"""Errors of versions of calibrations.

CalibrationVersionError
├── CalibrationNotFoundError   there is no such version
├── CheckNotFoundError         there is no such nine-point check
├── CalibrationWorseError      it is worse than the one in force, or nobody knows
├── CalibrationMisfitError     it belongs to another camera mode
└── NothingToRollBackError     the configuration is in force already
"""

from __future__ import annotations

from server.errors import PlugPilotError


class CalibrationVersionError(PlugPilotError):
    """A version of a calibration cannot be used like this."""

    code = "calibration_version"
    title = "That cannot be done with this calibration"
    status = 409


class CalibrationNotFoundError(CalibrationVersionError):
    """There is no such version."""

    code = "calibration_not_found"
    title = "There is no such calibration"
    status = 404
    remedy = "Look at the list of calibrations."


class CheckNotFoundError(CalibrationVersionError):
    """There is no such nine-point check."""

    code = "calibration_check_not_found"
    title = "There is no such check"
    status = 404
    remedy = "Look at the list of checks."


class CalibrationWorseError(CalibrationVersionError):
    """It is worse than the one in force, or was never measured."""

    code = "calibration_worse"
    title = "This calibration would make the robot worse"
    remedy = "Keep the one in force, or confirm that you want this one all the same."


class CalibrationMisfitError(CalibrationVersionError):
    """It was made with pictures of another size."""

    code = "calibration_misfit"
    title = "This calibration belongs to another camera mode"
    remedy = "Calibrate the camera in the mode that the robot uses."


class NothingToRollBackError(CalibrationVersionError):
    """The configuration is in force already."""

    code = "calibration_nothing_before"
    title = "There is nothing to go back to"
    remedy = "What the configuration says is in force already."
