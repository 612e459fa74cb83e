"""Kinematics of beta, the serial slide that carries the plug along the insertion axis.

In the plane y'-z' of the slide the plug tip moves on the line

    y' = e3y + rho3 sin(theta),   z' = e3z + rho3 cos(theta).

A distance sqrt((z' - e3z)^2 + (y' - e3y)^2) would lose the sign of rho3 and would hide points
off the line; the projection on the axis keeps the sign and its residual shows them.
"""

from __future__ import annotations

import math

from twin.geometry import RobotGeometry


def forward(geometry: RobotGeometry, rho3_mm: float) -> tuple[float, float]:
    """Plug tip (y', z') in the frame of the slide [mm]."""
    return (
        geometry.e3y_mm + rho3_mm * math.sin(geometry.theta_rad),
        geometry.e3z_mm + rho3_mm * math.cos(geometry.theta_rad),
    )


def inverse(geometry: RobotGeometry, y_mm: float, z_mm: float) -> tuple[float, float]:
    """Slide position whose tip is nearest to a point of the slide's plane.

    Args:
        geometry: The robot.
        y_mm: y' of the point [mm].
        z_mm: z' of the point [mm].

    Returns:
        (rho3, residual) [mm]: the projection on the insertion axis, and the signed distance of
        the point from it, positive on the side of +y'. Only points with residual 0 are reached.
    """
    sine, cosine = math.sin(geometry.theta_rad), math.cos(geometry.theta_rad)
    dy_mm, dz_mm = y_mm - geometry.e3y_mm, z_mm - geometry.e3z_mm
    return dy_mm * sine + dz_mm * cosine, dy_mm * cosine - dz_mm * sine
