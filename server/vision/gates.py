"""What a fitted pose must satisfy before it is believed."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.vision.errors import (
    AmbiguousTiltError,
    EdgesDisagreeError,
    EdgesDoNotFitError,
    ImplausibleDistanceError,
    ImplausibleTiltError,
    LabelCutOffError,
    LabelJumpedError,
    ModulesDisagreeError,
)
from server.vision.fitting.bit_agreement import bit_agreement
from server.vision.fitting.edge_fit import EdgeFit
from server.vision.fitting.start_pose import corners_mm
from server.vision.projection import Array, project, rotation_vector


@dataclass(frozen=True, slots=True)
class Gates:
    """Limits beyond which a pose is rejected, each with an error of its own.

    Attributes:
        rms_modules: Largest root mean square edge distance, in modules ...
        rms_px: ... or in pixels, whichever is more: small codes are drawn by few pixels.
        bend_modules: Largest shift of an edge by a bend that the fit found, in modules.
        bow_modules: Largest mean distance in any part of the code, which tells a strangely
            bent or pasted-over label from a noisy picture, in modules ...
        bow_rms: ... or times the root mean square: noise makes some part look bent, too.
        turn_sigma_deg: Largest standard deviation of the label's turn about any axis: the socket is
            a hand's breadth beside the label, where half a degree is a millimetre.
        inlier_share: Smallest share of edges that agree.
        bit_agreement: Smallest share of modules that look as the code says.
        nearest_mm: Smallest distance along the optical axis.
        farthest_mm: Largest distance.
        tilt_deg: Largest angle between the label's normal and the line of sight.
        tracked_turn_deg: A predicted pose that turns by more than this is not believed without
            reading the code: it may have turned to the opposite tilt.
        jump_mm: Largest distance between the label and its prediction ...
        jump_deg: ... and largest turn against it.
        tracked_fits: A predicted pose saves the decoding at most so often in a row; then the
            code is read again near its place, because a slipped fit can pass for a right one ...
        near_reads: ... and after so many of these in a row in the whole picture, where a second
            label with the same code would be seen.
    """

    rms_modules: float = 0.06
    rms_px: float = 0.35
    bend_modules: float = 0.12
    bow_modules: float = 0.06
    bow_rms: float = 1.5
    turn_sigma_deg: float = 0.5
    inlier_share: float = 0.82
    bit_agreement: float = 0.85
    nearest_mm: float = 40.0
    farthest_mm: float = 2000.0
    tilt_deg: float = 60.0
    tracked_turn_deg: float = 3.0
    jump_mm: float = 25.0
    jump_deg: float = 10.0
    tracked_fits: int = 10
    near_reads: int = 5

    def check_pose(self, pose: Array, camera: CameraModel, label_size_mm: float) -> None:
        """Let a pose pass that a label before this camera can have.

        Raises:
            ImplausibleDistanceError: too near or too far.
            ImplausibleTiltError: seen too much from the side, or from behind.
            LabelCutOffError: partly outside the picture.
        """
        distance_mm = float(pose[2, 3])
        if not self.nearest_mm <= distance_mm <= self.farthest_mm:  # so that NaN fails, too
            detail = (
                f"The label seems to be {distance_mm:.0f} mm away; "
                f"{self.nearest_mm:.0f} to {self.farthest_mm:.0f} mm are possible."
            )
            raise ImplausibleDistanceError(detail, distance_mm=round(distance_mm, 1))
        sight = pose[:3, 3] / np.linalg.norm(pose[:3, 3])
        tilt_deg = math.degrees(math.acos(float(np.clip(sight @ pose[:3, 2], -1, 1))))
        if not tilt_deg <= self.tilt_deg:
            detail = f"The label is tilted by {tilt_deg:.0f} degrees against the line of sight."
            raise ImplausibleTiltError(detail, tilt_deg=round(tilt_deg, 1))
        corners = project(camera, pose, corners_mm(label_size_mm)).pixels
        if np.any((corners < 0) | (corners > (camera.width - 1, camera.height - 1))):
            raise LabelCutOffError("The label is partly outside the picture.")

    def check_fit(
        self,
        fit: EdgeFit,
        image: NDArray[np.uint8],
        camera: CameraModel,
        modules: NDArray[np.bool_],
        label_size_mm: float,
    ) -> None:
        """Let a fit pass that the picture bears out.

        Args:
            fit: The fit.
            image: The picture it was made in, grey values, shape (height, width).
            camera: Intrinsics and distortion.
            modules: The code, True is black, shape (n, n).
            label_size_mm: Outer side of the code without its quiet zone.

        Raises:
            EdgesDoNotFitError: the residuals are too large, or how the label is bent is in doubt.
            AmbiguousTiltError: the picture tells too little of the tilt.
            EdgesDisagreeError: too few edges agree with the fit.
            ModulesDisagreeError: the modules look different from the code.
        """
        pose = fit.T_camera_label
        corners = project(camera, pose, corners_mm(label_size_mm)).pixels
        sides_px = np.sqrt(np.sum((corners - corners[[3, 0, 1, 2]]) ** 2, axis=1))
        module_px = float(np.mean(sides_px)) / modules.shape[0]
        most_px = max(self.rms_px, self.rms_modules * module_px)
        if not fit.rms_px <= most_px:
            detail = f"The edges are {fit.rms_px:.2f} px off; at most {most_px:.2f} px are allowed."
            raise EdgesDoNotFitError(detail, rms_px=round(fit.rms_px, 3))
        most_bow_px = max(self.bow_rms * fit.rms_px, self.bow_modules * module_px)
        if not fit.bow_px <= most_bow_px:
            detail = (
                f"A part of the code is {fit.bow_px:.2f} px beside where a flat label has it; "
                f"at most {most_bow_px:.2f} px are allowed."
            )
            raise EdgesDoNotFitError(detail, bow_px=round(fit.bow_px, 3))
        if not fit.bend_px <= self.bend_modules * module_px:
            detail = (
                f"The code is bent: a part of it is {fit.bend_px:.2f} px beside where a flat label "
                f"has it; at most {self.bend_modules * module_px:.2f} px are allowed."
            )
            raise EdgesDoNotFitError(detail, bend_px=round(fit.bend_px, 3))
        self._check_turn(fit)
        if fit.inlier_share < self.inlier_share:
            detail = f"Only {fit.inlier_share:.0%} of the edges agree with the fit."
            raise EdgesDisagreeError(detail, inlier_share=round(fit.inlier_share, 3))
        agreement = bit_agreement(image, camera, modules, pose, label_size_mm)
        agreement = max(agreement, 1 - agreement)  # an inverted code agrees in nothing
        if agreement < self.bit_agreement:
            detail = f"Only {agreement:.0%} of the modules look as the code says."
            raise ModulesDisagreeError(detail, bit_agreement=round(agreement, 3))

    def _check_turn(self, fit: EdgeFit) -> None:
        variance = float(np.linalg.eigvalsh(fit.covariance[:3, :3])[-1])
        sigma_deg = math.degrees(math.sqrt(variance))
        if sigma_deg <= self.turn_sigma_deg:
            return
        rest = (
            f"the tilt may be {sigma_deg:.1f} degrees off; "
            f"at most {self.turn_sigma_deg:.1f} are allowed."
        )
        if fit.bend_px > 0:
            detail = f"The label is bent, and which part of it is flat is not sure: {rest}"
            raise EdgesDoNotFitError(detail, turn_sigma_deg=round(sigma_deg, 2))
        detail = f"The picture tells too little of the label's tilt: {rest}"
        raise AmbiguousTiltError(detail, turn_sigma_deg=round(sigma_deg, 2))

    def check_jump(self, found: Array, predicted: Array) -> None:
        """Let a pose pass that is near its prediction, both shape (4, 4).

        Raises:
            LabelJumpedError: it is not.
        """
        jump_mm = float(np.linalg.norm(found[:3, 3] - predicted[:3, 3]))
        jump_deg = turn_deg(found, predicted)
        if not (jump_mm <= self.jump_mm and jump_deg <= self.jump_deg):
            detail = f"The label is {jump_mm:.1f} mm and {jump_deg:.1f} degrees from where it was."
            raise LabelJumpedError(detail, jump_mm=round(jump_mm, 2), jump_deg=round(jump_deg, 2))


def turn_deg(one: Array, other: Array) -> float:
    """Angle of the rotation from one pose to another, both shape (4, 4) [deg]."""
    turn = rotation_vector(one[:3, :3] @ other[:3, :3].T)
    return math.degrees(float(np.linalg.norm(turn)))
