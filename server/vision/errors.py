"""Errors of the vision room.

VisionError
├── InvalidCameraFileError    a camera file is missing, not TOML, or holds a wrong key or value
├── ImageUnreadableError      a file is missing or is not a picture
├── ImageSizeMismatchError    the picture's resolution is not the camera model's
├── NoCodeError               no QR code was found in the picture
├── WrongPayloadError         codes were found, but not the expected one
└── PoseRejectedError         the code was read, but its pose does not deserve trust
    └── MirroredCodeError     the code is seen in a mirror, or the camera flips its pictures
"""

from __future__ import annotations

from server.errors import PlugPilotError


class VisionError(PlugPilotError):
    """Base of everything the vision room raises on purpose."""

    code = "vision_error"
    title = "The label cannot be located"
    status = 422
    remedy = "Check that the label is whole, clean, lit and in view."


class InvalidCameraFileError(VisionError):
    """The camera file cannot be used; the detail names the key, its value and what is allowed."""

    code = "invalid_camera_file"
    title = "The camera file cannot be used"
    remedy = (
        "Write width, height, fx, fy, cx, cy [px] and, where known, k1, k2, p1, p2, k3 "
        "into a TOML file."
    )


class ImageUnreadableError(VisionError):
    """The file is missing or is not a picture that can be decoded."""

    code = "image_unreadable"
    title = "The picture cannot be read"
    remedy = "Give a PNG, JPEG or WebP file that exists and may be read."


class ImageSizeMismatchError(VisionError):
    """The picture has another resolution than the camera model: its intrinsics do not apply."""

    code = "resolution_mismatch"
    title = "The picture is not of this camera model's resolution"
    remedy = "Use the camera file that was made at the resolution of the pictures."


class NoCodeError(VisionError):
    """No QR code was found in the picture."""

    code = "no_code"
    title = "There is no readable QR code in the picture"
    remedy = "Check that the label is whole, clean, lit, in focus and in view."


class WrongPayloadError(VisionError):
    """QR codes were found, but none carries the expected text; ``found`` lists what was read."""

    code = "wrong_payload"
    title = "This is another label"
    remedy = "Check that the right vehicle stands here, or teach its new label."


class PoseRejectedError(VisionError):
    """The code was read, but the fitted pose failed a plausibility gate."""

    code = "pose_rejected"
    title = "The pose of the label is not certain"
    remedy = "Check that the label is flat, whole, in focus and of the size that was entered."


class MirroredCodeError(PoseRejectedError):
    """The code is mirrored: every pose computed from it would be wrong."""

    code = "mirrored_code"
    title = "The label is seen in a mirror"
    remedy = "Switch off the flip of the camera, or remove the mirror in front of it."
