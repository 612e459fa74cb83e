"""What the camera says of the carriages: a label that stands still is the rule."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from server.calibration.robot.looks import LabelLook
from twin.as_built import PlanarAsBuilt

Array = NDArray[np.float64]


def carriages_moved_mm(
    mechanism: PlanarAsBuilt, R_base_camera: Array, first: LabelLook, now: LabelLook
) -> Array:
    """How far the carriages stand from where they stood, by the camera alone.

    The platform has moved against the label; J^-1 carries that over to the carriages, which is
    good for moves of some millimetres.

    Args:
        mechanism: The robot as far as known.
        R_base_camera: How the camera is turned, shape (3, 3).
        first: A look.
        now: Another one from nearly the same place.

    Returns:
        Shape (2,) [mm].
    """
    platform_mm = -(R_base_camera @ (now.label_mm - first.label_mm))[:2]
    (jacobian,) = mechanism.jacobians_many(first.rho_mm[np.newaxis])
    return np.asarray(np.linalg.solve(jacobian, platform_mm))
