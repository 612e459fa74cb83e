"""From where the label is in the picture."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from drivers.camera import CameraModel
from server.calibration.robot.looks import LabelLook
from twin.geometry import RobotGeometry
from twin.kinematics import alpha, singularity

Array = NDArray[np.float64]

STEP_MM = 20.0
REACH_MM = 220.0
EDGE_PX = 25.0
"""Room for a camera that is turned by 3 degrees. More would keep the looks so near together that
the mechanism is extrapolated over half of the box; a place that then misses the label is left out.
"""
RAIL_END_MM = 8.0
LABEL_MARGIN = 1.16
"""Code and the quiet zone that the reader needs, over the code alone."""


def places_with_label(
    geometry: RobotGeometry,
    optics: CameraModel,
    R_base_camera: Array,
    *,
    centre_mm: Array,
    seen: LabelLook,
    label_size_mm: float,
) -> Array:
    """Carriages of a grid of places from which the whole label should be in the picture.

    Args:
        geometry: Of the robot as drawn.
        optics: Of the camera.
        R_base_camera: How it is turned as far as known, shape (3, 3).
        centre_mm: Where the platform stood at one look, shape (2,) [mm].
        seen: What that look saw.
        label_size_mm: Side of the code.

    Returns:
        (rho1, rho2) of the drawing, shape (n, 2) [mm].
    """
    steps = np.arange(-REACH_MM, REACH_MM + 1, STEP_MM)
    away = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    label_mm = seen.label_mm - np.column_stack((away, np.zeros(len(away)))) @ R_base_camera
    turned = abs(np.cos(seen.turned_rad)) + abs(np.sin(seen.turned_rad))
    half_mm = 0.5 * LABEL_MARGIN * label_size_mm * turned
    room_px = EDGE_PX + optics.fx * half_mm / label_mm[:, 2]
    u = optics.cx + optics.fx * label_mm[:, 0] / label_mm[:, 2]
    v = optics.cy + optics.fy * label_mm[:, 1] / label_mm[:, 2]
    inside = (u > room_px) & (u < optics.width - room_px)
    inside &= (v > room_px) & (v < optics.height - room_px)
    rho = alpha.inverse_many(geometry, (centre_mm + away)[inside])
    low = np.array([geometry.rho1.min_mm, geometry.rho2.min_mm]) + RAIL_END_MM
    high = np.array([geometry.rho1.max_mm, geometry.rho2.max_mm]) - RAIL_END_MM
    rho = rho[np.all((rho > low) & (rho < high), axis=1)]
    joints = np.column_stack((rho, np.full(len(rho), geometry.rho3.min_mm)))
    limits = singularity.thresholds(singularity.SingularityLimits())
    regular = np.all(singularity.measures_many(geometry, joints) >= limits, axis=1)
    return rho[regular]
