"""From a picture to the pose of the label with its covariance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.vision.errors import (
    AmbiguousLabelError,
    FitFailedError,
    MirroredCodeError,
    PoseRejectedError,
    WrongPayloadError,
)
from server.vision.fitting.bit_agreement import bit_agreement
from server.vision.fitting.code_edges import code_edges
from server.vision.fitting.corner_pose import corner_pose
from server.vision.fitting.edge_fit import EdgeFit, fit_edges
from server.vision.fitting.opposite_tilt import may_be_opposite
from server.vision.fitting.start_pose import corners_mm, start_poses
from server.vision.fitting.two_poses import fit_best
from server.vision.gates import Gates, turn_deg
from server.vision.label_pose import LabelPose
from server.vision.markers.code import Code
from server.vision.markers.marker import Marker
from server.vision.markers.qr_codes import QrCodes
from server.vision.picture_checks import (
    check_label_size,
    check_picture,
    check_resolution,
    no_code,
)
from server.vision.projection import project

Image = NDArray[np.uint8]
Pose = NDArray[np.float64]

_INVERTED_AGREEMENT = 0.4
"""A code whose modules agree with less than this is white on black."""


@dataclass(slots=True)
class _Track:
    """What a prediction needs of the code that was read last.

    Attributes:
        payload: Its text.
        modules: Its modules, True is black.
        inverted: It is white on black.
        fits: How often it was located since it was read.
        reads: How often it was read since the whole picture was searched.
    """

    payload: str
    modules: NDArray[np.bool_]
    inverted: bool
    fits: int = 0
    reads: int = 0


class Locator:
    """Finds the label in the pictures of one camera.

    It remembers the modules of the last code it read, so that a predicted pose can be refined
    without decoding; nothing else carries over from picture to picture. Not for use by several
    threads at once.

    Args:
        camera: Its calibrated optics.
        gates: What a pose must satisfy.
        marker: The kind of marker to look for; QR codes if not given.
    """

    def __init__(
        self, camera: CameraModel, gates: Gates | None = None, marker: Marker | None = None
    ) -> None:
        self._camera = camera
        self._gates = gates or Gates()
        self._marker = marker or QrCodes()
        self._track: _Track | None = None

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
        moving: bool = False,
    ) -> LabelPose:
        """Locate the label.

        Args:
            image: Grey values, shape (height, width) of the camera model.
            label_size_mm: Outer side of the code without its quiet zone.
            expected_payload: Only a label with this text will do; None takes the largest code.
            predicted: T_camera_label where the label is expected. Within about half a module,
                1% of the distance and 3 degrees it saves decoding; farther off the picture is
                searched; farther than the gates' jump the pose is rejected.
            moving: Label or camera moves: the shear of a sensor that reads row by row is taken
                out, and the pose is that of the middle row. The tilt is less certain then.

        Raises:
            ValueError: the picture is not two-dimensional uint8.
            InvalidLabelSizeError: no label has this size.
            ImageSizeMismatchError: the picture has another resolution than the camera model.
            NoCodeError: there is no readable code (its kinds: too dark, too bright).
            WrongPayloadError: there are codes, but not the expected one.
            AmbiguousLabelError: the expected code is there more than once.
            PoseRejectedError: the pose failed a gate; its kinds say which.
        """
        check_label_size(label_size_mm)
        check_picture(image)
        check_resolution(image, self._camera)
        if predicted is None:
            code = self.read(image, expected_payload)
            return self.fit(image, code, label_size_mm, moving=moving)
        found = self._followed(image, label_size_mm, expected_payload, predicted, moving=moving)
        if found is None:
            code = self.read(image, expected_payload)
            found = self.fit(image, code, label_size_mm, moving=moving)
        self._gates.check_jump(found.T_camera_label, predicted)
        return found

    def read(self, image: Image, expected_payload: str | None = None) -> Code:
        """Decode the expected code, or the largest one.

        Raises:
            NoCodeError: there is no readable code.
            WrongPayloadError: there are codes, but not the expected one.
            AmbiguousLabelError: the code is there more than once.
        """
        codes = self._marker.find(image, wanted=expected_payload)
        if not codes:
            raise no_code(image)
        wanted = codes[0].payload if expected_payload is None else expected_payload
        alike = [code for code in codes if code.payload == wanted]
        if not alike:
            found = [code.payload for code in codes]
            detail = f"Expected the label {wanted!r} but read {', '.join(map(repr, found))}."
            raise WrongPayloadError(detail, expected=wanted, found=found)
        if any(not code.is_same_place(alike[0]) for code in alike[1:]):
            raise AmbiguousLabelError(f"The label {wanted!r} is in the picture more than once.")
        return alike[0]

    def fit(
        self, image: Image, code: Code, label_size_mm: float, *, moving: bool = False
    ) -> LabelPose:
        """Fit the pose of a code that was read in the same picture.

        The picture may have another resolution than the camera model; its pixels are then taken
        as the camera's pixel coordinates.

        Raises:
            ValueError: the picture is not two-dimensional uint8.
            InvalidLabelSizeError: no label has this size.
            PoseRejectedError: the pose failed a gate; its kinds say which.
        """
        check_label_size(label_size_mm)
        check_picture(image)
        if code.mirrored:
            raise MirroredCodeError(f"The code {code.payload!r} is mirrored.")
        starts = start_poses(self._camera, code.corners_px, label_size_mm)
        if not starts:
            raise FitFailedError("The corners are not those of a square before the camera.")
        poses = [start.T_camera_label for start in starts]
        agreement = bit_agreement(image, self._camera, code.modules, poses[0], label_size_mm)
        track = _Track(code.payload, code.modules, inverted=agreement < _INVERTED_AGREEMENT)
        edges = code_edges(code.modules, label_size_mm)
        fit = fit_best(image, self._camera, edges, poses, inverted=track.inverted, moving=moving)
        found = self._passed(fit, image, track, label_size_mm)
        self._track = track
        return found

    def coarse(self, code: Code, label_size_mm: float) -> LabelPose:
        """Pose from the four corners alone, for codes whose edges do not fit (bent, damaged).

        It is for people to look at; nothing may move on it.

        Raises:
            PoseRejectedError: the corners are not those of a square in front of the camera
                (MirroredCodeError for a mirrored code).
        """
        check_label_size(label_size_mm)
        return corner_pose(self._camera, code, label_size_mm)

    def _followed(
        self,
        image: Image,
        label_size_mm: float,
        expected_payload: str | None,
        predicted: Pose,
        *,
        moving: bool,
    ) -> LabelPose | None:
        """Refine a prediction with the modules of the last code; None if that does not fit."""
        track = self._track
        if track is None or expected_payload not in {None, track.payload}:
            return None
        if track.fits >= self._gates.tracked_fits:
            if track.reads >= self._gates.near_reads or predicted[2, 3] <= 0:
                return None
            corners = project(self._camera, predicted, corners_mm(label_size_mm)).pixels
            code = self._marker.find_near(image, corners, track.payload)
            if code is None or code.mirrored:
                return None
            track.modules, track.fits, track.reads = code.modules, 0, track.reads + 1
        edges = code_edges(track.modules, label_size_mm)
        fit = fit_edges(
            image, self._camera, edges, predicted, inverted=track.inverted, moving=moving
        )
        if fit is None:
            return None
        if may_be_opposite(self._camera, edges, fit):
            return None
        if turn_deg(fit.T_camera_label, predicted) > self._gates.tracked_turn_deg:
            return None
        try:
            found = self._passed(fit, image, track, label_size_mm)
        except PoseRejectedError:
            return None
        track.fits += 1
        return found

    def _passed(self, fit: EdgeFit, image: Image, track: _Track, label_size_mm: float) -> LabelPose:
        """The pose of a fit that passes all gates; otherwise the error of the first it fails."""
        self._gates.check_pose(fit.T_camera_label, self._camera, label_size_mm)
        self._gates.check_fit(fit, image, self._camera, track.modules, label_size_mm)
        return LabelPose(
            payload=track.payload,
            T_camera_label=fit.T_camera_label,
            covariance=fit.covariance,
            rms_px=fit.rms_px,
            inlier_share=fit.inlier_share,
            edge_count=fit.edge_count,
            spread_px=fit.spread_px,
        )
