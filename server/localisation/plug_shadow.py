"""What the robot's own plug hides from its camera."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def hidden_by_plug(
    points: Array, *, tip: Array, axis: Array, length_mm: float, radius_mm: float
) -> NDArray[np.bool_]:
    """Whether the line of sight to a point passes through the plug, shape (...).

    The plug is a cylinder from the platform to its tip. Where sight line and plug axis lie nearest,
    both no longer than they really are, the distance of the two lines decides.

    Args:
        points: From the camera, shape (..., 3) [mm], in any axes that tip and axis share.
        tip: Of the plug, from the camera, shape (3,) [mm].
        axis: Unit vector from the platform to the tip, shape (3,).
        length_mm: Of the plug.
        radius_mm: Of the plug, with whatever room beside it is wanted.
    """
    distance = np.linalg.norm(points, axis=-1)
    sight = points / distance[..., None]
    # Nearest points of the sight line (s along it) and the plug's axis (t back from the tip).
    along = sight @ axis
    denominator = np.maximum(1.0 - along**2, 1e-9)
    s = (sight @ tip - along * (tip @ axis)) / denominator
    t = np.clip(s * along - tip @ axis, -length_mm, 0.0)
    nearest = tip + t[..., None] * axis
    s = np.clip((nearest * sight).sum(axis=-1), 0.0, distance)
    gap = np.linalg.norm(s[..., None] * sight - nearest, axis=-1)
    return np.asarray(gap < radius_mm)
