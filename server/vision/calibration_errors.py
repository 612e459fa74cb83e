"""What a wrong calibration or a wrongly measured label does to every pose alike.

Such errors do not differ from picture to picture, so no average removes them. They cancel where
a pose is compared with one that was taught with the same camera and the same label, seen at the
same place in the picture; where a pose is used as it is, they count.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from drivers.camera import CameraModel
from server.vision.projection import Array


@dataclass(frozen=True, slots=True)
class CalibrationErrors:
    """Standard deviations of what was measured beforehand.

    The defaults are what a careful calibration with some thirty pictures and a ruler give.

    Attributes:
        focal_share: Of the focal length, relative to it.
        principal_px: Of the principal point, along each axis.
        size_mm: Of the label's side.
    """

    focal_share: float = 5e-4
    principal_px: float = 0.5
    size_mm: float = 0.05

    def covariance(self, T_camera_label: Array, camera: CameraModel, label_size_mm: float) -> Array:
        """Covariance of (omega, tau) to first order, shape (6, 6) [rad, mm].

        With p the size of the label in the picture, z = f s / p and x = s (u - cx) / p: the size
        s scales all of t, the focal length f scales z alone, and the principal point cx shifts
        the label by z / f times its error (it hardly turns it).
        """
        x, y, z = T_camera_label[:3, 3]
        size_share = self.size_mm / label_size_mm
        by_size = np.array([0.0, 0.0, 0.0, x, y, z]) * size_share
        by_focal = np.array([0.0, 0.0, 0.0, 0.0, 0.0, z]) * self.focal_share
        by_cx = np.array([0.0, 0.0, 0.0, z * self.principal_px / camera.fx, 0.0, 0.0])
        by_cy = np.array([0.0, 0.0, 0.0, 0.0, z * self.principal_px / camera.fy, 0.0])
        parts = (by_size, by_focal, by_cx, by_cy)
        return np.asarray(sum(np.outer(part, part) for part in parts), dtype=np.float64)
