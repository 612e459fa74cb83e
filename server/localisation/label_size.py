"""Is the label as large as its owner says? Two looks from different places tell.

A label printed or shown in another size seems to be nearer or farther by the same ratio, and one
picture cannot tell. But when the camera moves by a known way, the label must seem to move by the
same way. With s the true size over the entered one, p the label in the base frame, c_i the camera
and a_i the label relative to it (turned into the base frame, computed with the entered size),

    p = c_i + s a_i   for every look i,

which is linear in s and p. Ways across the picture are measured in units of the label itself, so
a wrong focal length does not matter.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from server.localisation.errors import LabelSizeWrongError
from server.localisation.frames import Pose
from server.vision import LabelPose

ROBOT_SIGMA_MM = 0.5
"""How well the robot knows a way it went: play, sag and the camera's mount."""

TOLERANCE = 0.015
"""A smaller error of the size is not worth stopping for: 4 mm in depth at 270 mm."""

CERTAINTY = 3.0
"""The error must be this many times its own standard deviation."""

MOST_LOOKS = 8


@dataclass(frozen=True, slots=True)
class SizeEstimate:
    """True size of the label over the entered one.

    Attributes:
        ratio: Best estimate.
        sigma: Its standard deviation; infinite before the camera has moved.
    """

    ratio: float
    sigma: float


@dataclass(frozen=True, slots=True, eq=False)
class _Look:
    """One look from standstill, in the base frame.

    Attributes:
        camera_mm: Place of the camera, shape (3,).
        to_label_mm: From there to the label, computed with the entered size, shape (3,).
        information: Inverse covariance of their sum [1/mm^2], shape (3, 3).
    """

    camera_mm: NDArray[np.float64]
    to_label_mm: NDArray[np.float64]
    information: NDArray[np.float64]


class LabelSizeCheck:
    """Collects looks at one label that stays where it is."""

    def __init__(self) -> None:
        self._looks: list[_Look] = []

    def add(self, sighting: LabelPose, T_base_camera: Pose) -> None:
        """Take in a look from standstill."""
        rotation = T_base_camera[:3, :3]
        covariance = rotation @ sighting.covariance[3:, 3:] @ rotation.T
        covariance += ROBOT_SIGMA_MM**2 * np.eye(3)
        look = _Look(
            camera_mm=T_base_camera[:3, 3].copy(),
            to_label_mm=rotation @ sighting.T_camera_label[:3, 3],
            information=np.asarray(np.linalg.inv(covariance), dtype=np.float64),
        )
        # The first look stays: from there it is farthest to where the robot goes.
        if len(self._looks) == MOST_LOOKS:
            del self._looks[1]
        self._looks.append(look)

    @property
    def estimate(self) -> SizeEstimate:
        """Weighted least squares for s and p."""
        normal, right = np.zeros((4, 4)), np.zeros(4)
        for look in self._looks:
            design = np.column_stack((look.to_label_mm, -np.eye(3)))
            normal += design.T @ look.information @ design
            right -= design.T @ look.information @ look.camera_mm
        if len(self._looks) < 2:
            return SizeEstimate(1.0, math.inf)
        # Without p: what the looks' differences alone say about s.
        about_place = normal[1:, 1:]
        gain = np.linalg.solve(about_place, normal[1:, 0])
        information = float(normal[0, 0] - normal[0, 1:] @ gain)
        if information < 1e-6:
            return SizeEstimate(1.0, math.inf)
        ratio = float(right[0] - gain @ right[1:]) / information
        return SizeEstimate(ratio, 1 / math.sqrt(information))

    def require_right_size(self, label_size_mm: float) -> None:
        """Let a label pass that may be of the entered size.

        Raises:
            LabelSizeWrongError: it certainly is not.
        """
        found = self.estimate
        error = abs(found.ratio - 1)
        if error > TOLERANCE and error > CERTAINTY * found.sigma:
            true_mm = found.ratio * label_size_mm
            raise LabelSizeWrongError(
                f"The label is {true_mm:.1f} mm large, but {label_size_mm:g} mm were entered.",
                measured_mm=round(true_mm, 2),
                entered_mm=label_size_mm,
                sigma_mm=round(found.sigma * label_size_mm, 2),
            )
