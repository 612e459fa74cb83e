"""The result of locating a label."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray


class PoseSource(StrEnum):
    """What a pose was computed from."""

    EDGES = "edges"
    """All module edges: the accurate fit."""

    CORNERS = "corners"
    """Only the four corners of the code: coarse, its tilt near head-on is a guess."""


@dataclass(frozen=True, slots=True, eq=False)
class LabelPose:
    """Where the label is.

    The covariance belongs to the perturbation delta = (omega, tau) with

        R' = exp([omega]x) R,    t' = t + tau,

    omega [rad] about the label's centre and tau [mm], both along the axes of the camera frame
    (a left perturbation). Its lower right block is the covariance of the translation itself.
    It holds what differs from picture to picture (noise, pixel grid), not what is common to all
    pictures of a camera (wrong focal length, principal point, distortion or label size).

    Attributes:
        payload: Text of the code.
        T_camera_label: Maps label coordinates (origin the code's centre, x right, y down, z into
            the car) to the camera frame, shape (4, 4), translation [mm].
        covariance: Of (omega, tau), shape (6, 6) [rad, mm].
        rms_px: Root mean square distance of the inlying measurements from the model [px].
        inlier_share: Share of the measurements that agree with the model, 0 to 1.
        edge_count: Number of measurements looked at (4 if the source is the corners).
        spread_px: Outward shift of all black areas by ink, blur and gamma [px].
        source: What the pose was computed from.
    """

    payload: str
    T_camera_label: NDArray[np.float64]
    covariance: NDArray[np.float64]
    rms_px: float
    inlier_share: float
    edge_count: int
    spread_px: float
    source: PoseSource = PoseSource.EDGES

    @property
    def translation_sigma_mm(self) -> NDArray[np.float64]:
        """Standard deviations of the translation x, y, z [mm]."""
        return np.asarray(np.sqrt(np.diag(self.covariance)[3:]))

    @property
    def rotation_sigma_rad(self) -> NDArray[np.float64]:
        """Standard deviations of the rotation about camera x, y, z [rad]."""
        return np.asarray(np.sqrt(np.diag(self.covariance)[:3]))
