"""What a fitted pose must satisfy before it is believed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.vision.bit_agreement import bit_agreement
from server.vision.edge_fit import EdgeFit
from server.vision.errors import PoseRejectedError
from server.vision.projection import project
from server.vision.start_pose import corners_mm


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

    def check(
        self,
        fit: EdgeFit,
        image: NDArray[np.uint8],
        camera: CameraModel,
        modules: NDArray[np.bool_],
        label_size_mm: float,
    ) -> None:
        """Let a fit pass.

        Args:
            fit: The fit.
            image: The picture it was made in, grey values, shape (height, width).
            camera: Intrinsics and distortion.
            modules: The code, True is black, shape (n, n).
            label_size_mm: Outer side of the code without its quiet zone.

        Raises:
            PoseRejectedError: the fit fails a gate; the detail names the first.
        """
        pose = fit.T_camera_label
        if not np.all(np.isfinite(pose)) or pose[2, 3] <= 0 or pose[2, 2] <= 0:
            raise PoseRejectedError("The fit put the label behind the camera.")
        corners = project(camera, pose, corners_mm(label_size_mm)).pixels
        height, width = image.shape
        if np.any((corners < 0) | (corners > (width - 1, height - 1))):
            raise PoseRejectedError("The label is partly outside the picture.")
        side_px = float(np.mean(np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=1)))
        most_px = max(self.rms_px, self.rms_modules * side_px / modules.shape[0])
        if fit.rms_px > most_px:
            detail = f"The edges are {fit.rms_px:.2f} px off; at most {most_px:.2f} px are allowed."
            raise PoseRejectedError(detail)
        if fit.inlier_share < self.inlier_share:
            raise PoseRejectedError(f"Only {fit.inlier_share:.0%} of the edges agree with the fit.")
        agreement = bit_agreement(image, camera, modules, pose, label_size_mm)
        agreement = max(agreement, 1 - agreement)  # an inverted code agrees in nothing
        if agreement < self.bit_agreement:
            raise PoseRejectedError(f"Only {agreement:.0%} of the modules look as the code says.")
