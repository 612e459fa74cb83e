"""Why a camera could not be calibrated."""

from __future__ import annotations

from server.errors import PlugPilotError


class CameraCalibrationError(PlugPilotError):
    """Base of all reasons."""

    code = "camera_calibration"
    title = "The camera cannot be calibrated"
    status = 422
    remedy = "Take more pictures of the whole board, from near and far and at an angle."


class NoBoardError(CameraCalibrationError):
    """Too few pictures show the board."""

    code = "calibration_no_board"
    title = "The board was not found in enough pictures"


class MixedResolutionError(CameraCalibrationError):
    """The pictures do not have one size."""

    code = "calibration_mixed_resolution"
    title = "The pictures have different sizes"
    remedy = "Take all pictures with the same camera in the mode that the robot uses."


class WrongBoardError(CameraCalibrationError):
    """The markers are there, but not as on our board."""

    code = "calibration_wrong_board"
    title = "This is another board"
    remedy = "Print the board with `plugpilot label --board`, or give the size of its squares."


class CalibrationDivergedError(CameraCalibrationError):
    """The equations have no sensible solution."""

    code = "calibration_diverged"
    title = "The pictures do not fit together"
    remedy = "Check that the board is flat and did not move in the pictures; take them anew."
