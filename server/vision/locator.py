"""From a picture to the pose of the label with its covariance."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.vision.bit_agreement import bit_agreement
from server.vision.code_edges import code_edges
from server.vision.corner_pose import corner_pose
from server.vision.decode import Code, find_codes
from server.vision.edge_fit import fit_edges
from server.vision.errors import (
    ImageSizeMismatchError,
    MirroredCodeError,
    NoCodeError,
    PoseRejectedError,
    WrongPayloadError,
)
from server.vision.gates import Gates
from server.vision.label_pose import LabelPose
from server.vision.start_pose import start_poses
from twin.qr_label import label_modules

Image = NDArray[np.uint8]
Pose = NDArray[np.float64]

OWN_LABEL_AGREEMENT = 0.9
"""Sampled modules that agree this well with our own encoding of the text are one of our labels."""


UNDOUBTED_RMS_PX = 0.1
"""A fit this good did not settle on the opposite tilt; of those it leaves more than 0.2 px."""


class _LastCode(NamedTuple):
    """What a prediction needs of the code that was read last."""

    payload: str
    modules: NDArray[np.bool_]


class Locator:
    """Finds the label in the pictures of one camera.

    It remembers the modules of the last code it read, so that a predicted pose can be refined
    without decoding; nothing else carries over from picture to picture. Not for use by several
    threads at once.
    """

    def __init__(self, camera: CameraModel, gates: Gates | None = None) -> None:
        self._camera = camera
        self._gates = gates or Gates()
        self._last: _LastCode | None = None
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
        modules = _known_modules(code)
        found: LabelPose | None = None
        rejection = PoseRejectedError("The corners are not those of a square before the camera.")
        for start in start_poses(self._camera, code.corners_px, label_size_mm):
            try:
                fit = self._refine(
                    image, code.payload, modules, start.T_camera_label, label_size_mm
                )
            except PoseRejectedError as error:
                rejection = error
                continue
            if found is None or fit.rms_px < found.rms_px:
                found = fit
            if found.rms_px < UNDOUBTED_RMS_PX:
                break
        if found is None:
            raise rejection
        self._last, self._tracked = _LastCode(code.payload, modules), 0
        return found

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
        try:
            found = self._refine(image, last.payload, last.modules, predicted, label_size_mm)
        except PoseRejectedError:
            return None
        self._tracked += 1
        return found

    def _refine(
        self,
        image: Image,
        payload: str,
        modules: NDArray[np.bool_],
        start: Pose,
        label_size_mm: float,
    ) -> LabelPose:
        """Fit from a start pose.

        Raises:
            PoseRejectedError: the fit does not settle or fails a gate.
        """
        edges = code_edges(modules, label_size_mm)
        at_start = bit_agreement(image, self._camera, modules, start, label_size_mm)
        fit = fit_edges(image, self._camera, edges, start, inverted=at_start < 0.4)
        if fit is None:
            raise PoseRejectedError("Too few edges are visible, or the fit does not settle.")
        self._gates.check(fit, image, self._camera, modules, label_size_mm)
        return LabelPose(
            payload=payload,
            T_camera_label=fit.T_camera_label,
            covariance=fit.covariance,
            rms_px=fit.rms_px,
            inlier_share=fit.inlier_share,
            edge_count=fit.edge_count,
            spread_px=fit.spread_px,
        )

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
