"""Errors of the vision room.

VisionError
├── InvalidCameraFileError      a camera file is missing, not TOML, or holds a wrong key or value
├── ImageUnreadableError        a file is missing or is not a picture
├── ImageSizeMismatchError      the picture's resolution is not the camera model's
├── InvalidLabelSizeError       no label has this size
├── NoCodeError                 no code was found in the picture
│   ├── PictureTooDarkError     because hardly any light reached the sensor
│   └── PictureTooBrightError   because most of the picture is clipped
├── WrongPayloadError           codes were found, but not the expected one
├── AmbiguousLabelError         the expected code is there more than once
└── PoseRejectedError           the code was read, but its pose does not deserve trust
    ├── MirroredCodeError       it is seen in a mirror, or the camera flips its pictures
    ├── FitFailedError          its edges lead to no pose
    ├── AmbiguousTiltError      two opposite tilts explain the picture
    ├── LabelCutOffError        it is partly outside the picture
    ├── EdgesDoNotFitError      the edges lie off a flat code of this kind
    ├── EdgesDisagreeError      too many edges are elsewhere, or covered
    ├── ModulesDisagreeError    the modules look different from what the code says
    ├── ImplausibleDistanceError  nearer or farther than the camera can be
    ├── ImplausibleTiltError    seen from the side
    └── LabelJumpedError        it is not where it was a moment ago
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


class InvalidLabelSizeError(VisionError):
    """The size is not a number of millimetres that a label can have."""

    code = "invalid_label_size"
    title = "No label has this size"
    remedy = "Measure the outer side of the printed code without its white margin, in millimetres."


class NoCodeError(VisionError):
    """No code was found in the picture."""

    code = "no_code"
    title = "There is no readable QR code in the picture"
    remedy = "Check that the label is whole, clean, lit, in focus and in view."


class PictureTooDarkError(NoCodeError):
    """No code was found because hardly any light reached the sensor."""

    code = "picture_too_dark"
    title = "The picture is too dark"
    remedy = "Switch the light on, or check that nothing covers the camera."


class PictureTooBrightError(NoCodeError):
    """No code was found because most of the picture is clipped."""

    code = "picture_too_bright"
    title = "The picture is too bright"
    remedy = "Shade the camera from the sun or the lamp, or shorten its exposure."


class WrongPayloadError(VisionError):
    """Codes were found, but none carries the expected text; ``found`` lists what was read."""

    code = "wrong_payload"
    title = "This is another label"
    remedy = "Check that the right vehicle stands here, or teach its new label."


class AmbiguousLabelError(VisionError):
    """The expected code is in the picture more than once: which one is beside the socket?"""

    code = "label_ambiguous"
    title = "The label is there more than once"
    remedy = "Remove the copy: only the label beside the socket may be in view."


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


class FitFailedError(PoseRejectedError):
    """The code was read, but its edges lead to no pose."""

    code = "fit_failed"
    remedy = "Check that the label is in focus, evenly lit and not half hidden."


class AmbiguousTiltError(PoseRejectedError):
    """Two opposite tilts explain the picture equally well, or it tells too little of the tilt.

    The label is too small or too far.
    """

    code = "tilt_ambiguous"
    title = "The label is too far away to measure its tilt"
    remedy = "Use a larger label, or park nearer."


class LabelCutOffError(PoseRejectedError):
    """The code reaches beyond the picture."""

    code = "label_cut_off"
    title = "The label is only partly in the picture"
    remedy = "Park nearer to the middle of the place, or use a smaller label."


class EdgesDoNotFitError(PoseRejectedError):
    """The edges do not lie where those of a flat code would: bent paper, wrong camera file."""

    code = "edges_do_not_fit"
    title = "The label is not flat"
    remedy = "Press the label flat, or replace it. If it is flat, calibrate the camera."


class EdgesDisagreeError(PoseRejectedError):
    """Too many edges are covered or elsewhere."""

    code = "edges_disagree"
    title = "Too much of the label is hidden"
    remedy = "Clean the label, and remove what covers it."


class ModulesDisagreeError(PoseRejectedError):
    """The modules do not look as the code says: covered, pasted over, or a fit that slipped."""

    code = "modules_disagree"
    title = "The label looks different from what its code says"
    remedy = "Clean the label, remove what is stuck on it, or replace it."


class ImplausibleDistanceError(PoseRejectedError):
    """Nearer or farther than a label can be: another label, or one of another size."""

    code = "distance_implausible"
    title = "The label seems to be at an impossible distance"
    remedy = "Check that this is the printed label of the size that was entered."


class ImplausibleTiltError(PoseRejectedError):
    """Tilted more than a label on a parked car can be."""

    code = "tilt_implausible"
    title = "The label is seen from the side"
    remedy = "Check that the label is flat on the car, and that the car stands straight."


class LabelJumpedError(PoseRejectedError):
    """The label is not where it was a moment ago, although neither should have moved."""

    code = "label_jumped"
    title = "The label moved"
    remedy = "Check that the car does not move, and that there is only one label; then try again."
