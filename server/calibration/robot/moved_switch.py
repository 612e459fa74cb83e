"""Has only a limit switch moved since the calibration in force was made?

Legs and belts do not change by themselves; the distance of the two carriages' zeros does when
somebody has moved a switch. The numbers of a new fit do not show it: what the looks tell least
about, the lengths of both legs together, differs by a millimetre between two good calibrations of
the same robot. So the calibration in force itself is tried with another distance of the zeros: if
that alone explains the new looks, that is what has happened.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from server.calibration.robot.looks import LabelLook
from server.calibration.robot.verdict import GOOD_MM, mechanism_error_mm
from twin.as_built import PlanarAsBuilt

Array = NDArray[np.float64]

FURTHEST_MM, COARSE_MM, FINE_MM = 12.0, 0.5, 0.02
LEAST_MM = 0.5
"""Homing finds a switch again to 0.05 mm; less than this is no reason to look for a screw."""
CLEARLY = 0.5
"""The looks must be missed by less than this share of what the calibration in force misses."""


def moved_switch_mm(
    looks: Sequence[LabelLook], R_base_camera: Array, in_force: PlanarAsBuilt
) -> float | None:
    """By how much the zeros of the carriages are further apart than they were.

    Which of the two has moved, the label does not tell.

    Args:
        looks: New ones, at one label.
        R_base_camera: How the camera is turned, shape (3, 3).
        in_force: The mechanism that was true before.

    Returns:
        That distance, negative for nearer together [mm]; None if no switch has moved, or not only
        a switch.
    """

    def missed_mm(further_mm: float) -> float:
        moved = in_force.right_foot_x_mm + further_mm
        tried = in_force.model_copy(update={"right_foot_x_mm": moved})
        if np.isnan(tried.forward_many(np.stack([look.rho_mm for look in looks]))).any():
            return np.inf
        return mechanism_error_mm(tried, R_base_camera, looks)

    coarse_mm = np.arange(-FURTHEST_MM, FURTHEST_MM + COARSE_MM, COARSE_MM)
    near_mm = coarse_mm[np.argmin([missed_mm(one) for one in coarse_mm])]
    fine_mm = near_mm + np.arange(-COARSE_MM, COARSE_MM + FINE_MM, FINE_MM)
    errors_mm = [missed_mm(one) for one in fine_mm]
    found_mm, left_mm = float(fine_mm[np.argmin(errors_mm)]), min(errors_mm)
    if abs(found_mm) < LEAST_MM or left_mm > min(GOOD_MM, CLEARLY * missed_mm(0.0)):
        return None
    return found_mm
