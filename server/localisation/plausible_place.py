"""Where the label of a parked car can be at all."""

from __future__ import annotations

import math

from server.localisation.errors import ImplausiblePlaceError
from server.localisation.frames import Pose
from twin.geometry import RobotGeometry
from twin.kinematics import gamma

BESIDE_MM = 500.0
"""Around the box of sockets that the robot serves: the label's own offset and bad parking."""

BEFORE_MM = 150.0
BEHIND_MM = 450.0
"""Nearer and farther than the plug's tip reaches."""

MOST_TILT_RAD = math.radians(45.0)


def require_plausible_place(geometry: RobotGeometry, T_base_label: Pose) -> None:
    """Let a label pass that can be on a car before this robot.

    It is wide: a socket that is merely out of reach is told as such elsewhere. What fails here
    is another label, or a telephone that shows it.

    Raises:
        ImplausiblePlaceError: it is where no car is, or turned as on no car.
    """
    x_mm, y_mm, z_mm = (float(value) for value in T_base_label[:3, 3])
    box = geometry.regular_box
    right_mm, up_mm = x_mm - box.center_x_mm, y_mm - box.center_y_mm
    nearest_mm = gamma.tip_offset(geometry, geometry.rho3.min_mm)[1] - BEFORE_MM
    farthest_mm = gamma.tip_offset(geometry, geometry.rho3.max_mm)[1] + BEHIND_MM
    inside = (
        abs(right_mm) <= box.width_mm / 2 + BESIDE_MM
        and abs(up_mm) <= box.height_mm / 2 + BESIDE_MM
        and nearest_mm <= z_mm <= farthest_mm
    )
    if not inside:
        raise ImplausiblePlaceError(
            f"The label seems to be {z_mm:.0f} mm from the wall, {right_mm:+.0f} mm beside and "
            f"{up_mm:+.0f} mm above the middle, where no parked car is.",
            x_mm=round(x_mm, 1),
            y_mm=round(y_mm, 1),
            z_mm=round(z_mm, 1),
        )
    axis = geometry.insertion_axis
    cosine = float(sum(a * b for a, b in zip(T_base_label[:3, 2], axis, strict=True)))
    if cosine < math.cos(MOST_TILT_RAD):
        tilt_deg = math.degrees(math.acos(max(-1.0, min(1.0, cosine))))
        raise ImplausiblePlaceError(
            f"The label seems to be tilted by {tilt_deg:.0f} degrees.", tilt_deg=round(tilt_deg, 1)
        )
