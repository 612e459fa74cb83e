"""Finds the QR label in a picture and says where it is, and how well that is known."""

from server.vision.average import combine
from server.vision.errors import AmbiguousLabelError, PoseRejectedError, VisionError
from server.vision.gates import Gates
from server.vision.label_pose import LabelPose, PoseSource
from server.vision.locator import Locator

__all__ = [
    "AmbiguousLabelError",
    "Gates",
    "LabelPose",
    "Locator",
    "PoseRejectedError",
    "PoseSource",
    "VisionError",
    "combine",
]
