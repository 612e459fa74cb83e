"""Errors of localisation.

LocalisationError
├── LabelNotFoundError       the label was in none of the looks
├── SocketUnreachableError   the socket is outside what the robot can reach
├── UncertainPoseError       the pose is not certain enough to insert
├── LabelSizeWrongError      the label is not as large as entered
├── ImplausiblePlaceError    the label is where no parked car is
└── CameraDownError          the camera does not deliver
"""

from __future__ import annotations

from server.errors import PlugPilotError


class LocalisationError(PlugPilotError):
    """The socket's place is not known well enough."""

    code = "localisation"
    title = "The socket cannot be located"
    status = 409


class LabelNotFoundError(LocalisationError):
    """The label was in none of the looks."""

    code = "label_not_found"
    title = "The label beside the socket was not found"
    remedy = (
        "Check that the car stands in its place, that the flap is open, "
        "and that the label is clean and lit."
    )


class SocketUnreachableError(LocalisationError):
    """The socket is outside what the robot can reach."""

    code = "socket_unreachable"
    title = "The robot cannot reach the socket"
    remedy = "Park the car again, nearer to the middle of its place."


class UncertainPoseError(LocalisationError):
    """The pose is not certain enough to insert."""

    code = "pose_uncertain"
    title = "The picture of the label is not sharp enough"
    remedy = "Clean the label and the camera, switch a light on, and try again."


class LabelSizeWrongError(LocalisationError):
    """Looks from different places show that the label is not as large as entered."""

    code = "label_size_wrong"
    title = "The label is not as large as entered"
    remedy = "Measure the printed code without its white margin, and enter its size."


class ImplausiblePlaceError(LocalisationError):
    """The label is where no parked car is: another label, a picture of it, or a wrong size."""

    code = "place_implausible"
    title = "The label is where no parked car is"
    remedy = "Check that the label is on the car, and that its size was entered rightly."


class CameraDownError(LocalisationError):
    """The camera does not deliver."""

    code = "camera_down"
    title = "The camera does not deliver pictures"
    status = 503
    remedy = "Check the camera's cable, then try again."
