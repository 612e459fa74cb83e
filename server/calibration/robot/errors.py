"""Errors of the robot's calibration.

RobotCalibrationError
├── TooFewLooksError         too few looks show the label
└── RobotFitDivergedError    no robot near the drawing explains them
"""

from __future__ import annotations

from server.errors import PlugPilotError


class RobotCalibrationError(PlugPilotError):
    """The robot cannot be calibrated from this."""

    code = "robot_calibration"
    title = "The robot cannot be calibrated"
    status = 409


class TooFewLooksError(RobotCalibrationError):
    """Too few looks show the label."""

    code = "robot_calibration_looks"
    title = "The label was seen too seldom"
    remedy = "Put the label where the robot's camera sees it from most of its workspace."


class RobotFitDivergedError(RobotCalibrationError):
    """No robot near the drawing explains the looks."""

    code = "robot_calibration_fit"
    title = "The looks fit to no robot like this"
    remedy = (
        "Check that the label did not move, that no axis is swapped or reversed, "
        "and that the drawing's lengths are those of this robot."
    )
