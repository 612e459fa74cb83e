"""From a picture to the pose of the label with its covariance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.vision.bit_agreement import bit_agreement
from server.vision.code_edges import code_edges
from server.vision.corner_pose import corner_pose
from server.vision.decode import Code, find_codes
from server.vision.edge_fit import EdgeFit, fit_edges
from server.vision.errors import (
    ImageSizeMismatchError,
    MirroredCodeError,
    NoCodeError,
    PoseRejectedError,
    WrongPayloadError,
)
from server.vision.label_pose import LabelPose
from server.vision.projection import project
from server.vision.start_pose import corners_mm, start_poses
from twin.qr_label import label_modules

Image = NDArray[np.uint8]
Pose = NDArray[np.float64]

OWN_LABEL_AGREEMENT = 0.9
"""Sampled modules that agree this well with our own encoding of the text are one of our labels."""


@dataclass(frozen=True, slots=True)
class Gates:
    """Limits beyond which a fit is rejected.

    Attributes:
        rms_modules: Largest root mean square edge distance, in modules ...
        rms_px: ... or in pixels, whichever is more: small codes are drawn by few pixels.
        inlier_share: Smallest share of edges that agree.
        bit_agreement: Smallest share of modules that look as the code says.
        tracked_fits: A predicted pose saves the decoding at most so often in a row; then the
            code is read again, because a slipped fit can pass for a right one.
    """

    rms_modules: float = 0.06
    rms_px: float = 0.35
    inlier_share: float = 0.6
    bit_agreement: float = 0.85
    tracked_fits: int = 10


class Locator:
    """Finds the label in the pictures of one camera.

    It remembers the modules of the last code it read, so that a predicted pose can be refined
    without decoding; nothing else carries over from picture to picture. Not for use by several
    threads at once.
    """

    def __init__(self, camera: CameraModel, gates: Gates | None = None) -> None:
        self._camera = camera
        self._gates = gates or Gates()
        self._last: Code | None = None
        self._tracked = 0

    @property
    def camera(self) -> CameraModel:
        """The camera whose pictures this locator understands."""
        return self._camera

    def locate(
        self,
        image: Image,
        *,
        label_size_mm: float,
        expected_payload: str | None = None,
        predicted: Pose | None = None,
    ) -> LabelPose:
        """Locate the label.

        Args:
            image: Grey values, shape (height, width) of the camera model.
            label_size_mm: Outer side of the code without its quiet zone.
            expected_payload: Only a label with this text will do; None takes the largest code.
            predicted: T_camera_label where the label is expected, within about half a module,
                1% of the distance and 3 degrees. Where the last code fits there, decoding is
                skipped; where it does not, the picture is searched as without a prediction.

        Raises:
            ValueError: label_size_mm is not positive or the picture is not two-dimensional uint8.
            ImageSizeMismatchError: the picture has another resolution than the camera model.
            NoCodeError: there is no readable code.
            WrongPayloadError: there are codes, but not the expected one.
            PoseRejectedError: the fit failed a gate (MirroredCodeError for a mirrored code).
        """
        _check_arguments(image, label_size_mm)
        self._check_size(image)
        if predicted is not None:
            tracked = self._track(image, label_size_mm, expected_payload, predicted)
            if tracked is not None:
                return tracked
        return self.fit(image, self.read(image, expected_payload), label_size_mm)

    def read(self, image: Image, expected_payload: str | None = None) -> Code:
        """Decode the expected code, or the largest one.

        Raises:
            NoCodeError: there is no readable code.
            WrongPayloadError: there are codes, but not the expected one.
        """
        codes = find_codes(image, wanted=expected_payload)
        if not codes:
            raise NoCodeError("No QR code was found in the picture.")
        if expected_payload is None:
            return codes[0]
        for code in codes:
            if code.payload == expected_payload:
                return code
        found = [code.payload for code in codes]
        detail = f"Expected the label {expected_payload!r} but read {', '.join(map(repr, found))}."
        raise WrongPayloadError(detail, expected=expected_payload, found=found)

    def fit(self, image: Image, code: Code, label_size_mm: float) -> LabelPose:
        """Fit the pose of a code that was read in the same picture.

        The picture may have another resolution than the camera model; its pixels are then taken
        as the camera's pixel coordinates.

        Raises:
            ValueError: label_size_mm is not positive or the picture is not two-dimensional uint8.
            PoseRejectedError: the fit failed a gate (MirroredCodeError for a mirrored code).
        """
        _check_arguments(image, label_size_mm)
        if code.mirrored:
            raise MirroredCodeError(f"The code {code.payload!r} is mirrored.")
        known = _known_modules(code)
        starts = start_poses(self._camera, code.corners_px, label_size_mm)
        reasons = ["its corners are not those of a square in front of the camera"]
        fits: list[LabelPose] = []
        for start in starts:
            result = self._refine(image, code.payload, known, start.T_camera_label, label_size_mm)
            if isinstance(result, str):
                reasons.append(result)
            else:
                fits.append(result)
                break
        if not fits:
            detail = f"The code {code.payload!r} was read, but not located: {reasons[-1]}."
            raise PoseRejectedError(detail)
        self._last, self._tracked = Code(code.payload, code.corners_px, known, mirrored=False), 0
        return fits[0]

    def coarse(self, code: Code, label_size_mm: float) -> LabelPose:
        """Pose from the four corners alone, for codes whose edges do not fit (bent, damaged).

        Raises:
            PoseRejectedError: the corners are not those of a square in front of the camera
                (MirroredCodeError for a mirrored code).
        """
        return corner_pose(self._camera, code, label_size_mm)

    def _track(
        self, image: Image, label_size_mm: float, expected_payload: str | None, predicted: Pose
    ) -> LabelPose | None:
        """Refine a prediction with the modules of the last code; None if that does not fit."""
        last = self._last
        if last is None or self._tracked >= self._gates.tracked_fits:
            return None
        if expected_payload not in {None, last.payload}:
            return None
        result = self._refine(image, last.payload, last.modules, predicted, label_size_mm)
        if isinstance(result, str):
            return None
        self._tracked += 1
        return result

    def _refine(
        self,
        image: Image,
        payload: str,
        modules: NDArray[np.bool_],
        start: Pose,
        label_size_mm: float,
    ) -> LabelPose | str:
        """Fit from a start pose; the sentence tells why it was rejected."""
        edges = code_edges(modules, label_size_mm)
        at_start = bit_agreement(image, self._camera, modules, start, label_size_mm)
        fit = fit_edges(image, self._camera, edges, start, inverted=at_start < 0.4)
        if fit is None:
            return "too few of its edges are visible, or the fit does not settle"
        problem = self._problem(image, modules, fit, label_size_mm)
        if problem is not None:
            return problem
        return LabelPose(
            payload=payload,
            T_camera_label=fit.T_camera_label,
            covariance=fit.covariance,
            rms_px=fit.rms_px,
            inlier_share=fit.inlier_share,
            edge_count=fit.edge_count,
            spread_px=fit.spread_px,
        )

    def _problem(
        self, image: Image, modules: NDArray[np.bool_], fit: EdgeFit, label_size_mm: float
    ) -> str | None:
        """Name the first gate that a fit fails."""
        pose, gates = fit.T_camera_label, self._gates
        corners = project(self._camera, pose, corners_mm(label_size_mm)).pixels
        height, width = image.shape
        inside = (corners >= 0) & (corners <= (width - 1, height - 1))
        if pose[2, 3] <= 0 or pose[2, 2] <= 0 or not np.all(np.isfinite(pose)):
            return "the fit put the label behind the camera"
        if not np.all(inside):
            return "the label is partly outside the picture"
        side = float(np.mean(np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=1)))
        most_px = max(gates.rms_px, gates.rms_modules * side / modules.shape[0])
        if fit.rms_px > most_px:
            return f"its edges are {fit.rms_px:.2f} px off, at most {most_px:.2f} px are allowed"
        if fit.inlier_share < gates.inlier_share:
            return f"only {fit.inlier_share:.0%} of the edges agree with it"
        agreement = bit_agreement(image, self._camera, modules, pose, label_size_mm)
        agreement = max(agreement, 1 - agreement)  # an inverted code agrees in nothing
        if agreement < gates.bit_agreement:
            return f"only {agreement:.0%} of the modules look as the code says"
        return None

    def _check_size(self, image: Image) -> None:
        expected = (self._camera.height, self._camera.width)
        if image.shape != expected:
            detail = (
                f"The picture is {image.shape[1]} x {image.shape[0]} px, but the camera model is "
                f"for {expected[1]} x {expected[0]} px."
            )
            raise ImageSizeMismatchError(detail)


def _check_arguments(image: Image, label_size_mm: float) -> None:
    if image.ndim != 2 or image.dtype != np.uint8:
        message = f"expected a grey uint8 picture, got shape {image.shape} of {image.dtype}"
        raise ValueError(message)
    if not (np.isfinite(label_size_mm) and label_size_mm > 0):
        message = f"label_size_mm must be a positive number, got {label_size_mm}"
        raise ValueError(message)


def _known_modules(code: Code) -> NDArray[np.bool_]:
    """Exact modules if the code is one of our own labels, the sampled ones otherwise."""
    try:
        own = label_modules(code.payload)
    except ValueError:
        return code.modules
    if own.shape == code.modules.shape and np.mean(own == code.modules) >= OWN_LABEL_AGREEMENT:
        return own
    return code.modules
