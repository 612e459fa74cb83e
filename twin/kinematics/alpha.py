"""Kinematics of alpha, the planar parallel robot that moves the platform along the wall.

Left leg A-B with A = (e1x + rho1, e1y), right leg E-C with E = (L2 - rho2 - e2x, e2y), both of
length L; B, C = V -/+ (L3/2, 0). Shifted by the half platform the legs meet in V, so that with

    d1 = x - e1x - rho1 - L3/2,        h1 = y - e1y,
    d2 = L2 - x - L3/2 - e2x - rho2,   h2 = y - e2y

the constraints are d1^2 + h1^2 = L^2 and d2^2 + h2^2 = L^2.

Working mode: d1 >= 0 and d2 >= 0 (both legs lean inwards). Assembly mode: the upper one,
d1 h2 + d2 h1 >= 0 (V on the car's side of the line between the two leg feet).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from twin.geometry import RobotGeometry
from twin.kinematics.errors import LegsCannotCloseError, UnreachableError, UnreachableReason

Array = NDArray[np.float64]


class PlatformPosition(NamedTuple):
    """Position of V, the midpoint of the platform, in the wall plane of the base frame [mm]."""

    x_mm: float
    y_mm: float


class LegVectors(NamedTuple):
    """Components of the two legs [mm]: d along the rail towards the platform, h away from it."""

    d1_mm: float
    h1_mm: float
    d2_mm: float
    h2_mm: float


def feet_mm(geometry: RobotGeometry, rho1_mm: float, rho2_mm: float) -> tuple[float, float]:
    """Abscissae of the leg feet shifted by the half platform, so that both circles meet in V."""
    half_mm = 0.5 * geometry.platform_width_mm
    left_mm = geometry.e1x_mm + rho1_mm + half_mm
    right_mm = geometry.base_width_mm - rho2_mm - geometry.e2x_mm - half_mm
    return left_mm, right_mm


def leg_vectors(
    geometry: RobotGeometry, v: PlatformPosition, rho1_mm: float, rho2_mm: float
) -> LegVectors:
    """Legs of a pose whose platform position is already known."""
    left_mm, right_mm = feet_mm(geometry, rho1_mm, rho2_mm)
    return LegVectors(
        v.x_mm - left_mm, v.y_mm - geometry.e1y_mm, right_mm - v.x_mm, v.y_mm - geometry.e2y_mm
    )


def inverse(geometry: RobotGeometry, v: PlatformPosition) -> tuple[float, float]:
    """Actuator positions (rho1, rho2) [mm] that put V there, joint limits not considered.

    rho1 = x - e1x - L3/2 - sqrt(L^2 - (y - e1y)^2)
    rho2 = L2 - x - L3/2 - e2x - sqrt(L^2 - (y - e2y)^2)

    Raises:
        UnreachableError: the legs are too short, or V lies on the wrong side of the carriages,
            or is not finite.
    """
    x_mm, y_mm = v
    if not (math.isfinite(x_mm) and math.isfinite(y_mm)):
        msg = f"({x_mm}, {y_mm}) is not a position"
        raise UnreachableError(msg, reason=UnreachableReason.NOT_FINITE, excess_mm=math.inf)
    length_mm = geometry.leg_length_mm
    h1_mm = y_mm - geometry.e1y_mm
    h2_mm = y_mm - geometry.e2y_mm
    lacking_mm = max(abs(h1_mm), abs(h2_mm)) - length_mm
    if lacking_mm > 0:
        msg = f"the legs are {lacking_mm:.1f} mm too short to put the platform at y = {y_mm:.1f} mm"
        raise UnreachableError(msg, reason=UnreachableReason.LEGS_TOO_SHORT, excess_mm=lacking_mm)
    d1_mm = math.sqrt(length_mm * length_mm - h1_mm * h1_mm)
    d2_mm = math.sqrt(length_mm * length_mm - h2_mm * h2_mm)
    if d1_mm * h2_mm + d2_mm * h1_mm < 0:
        feet_y_mm = (d2_mm * geometry.e1y_mm + d1_mm * geometry.e2y_mm) / (d1_mm + d2_mm)
        msg = (
            f"y = {y_mm:.1f} mm is {feet_y_mm - y_mm:.1f} mm on the wrong side of the carriages; "
            "the platform only moves above them"
        )
        raise UnreachableError(msg, reason=UnreachableReason.WRONG_SIDE, excess_mm=feet_y_mm - y_mm)
    half_mm = 0.5 * geometry.platform_width_mm
    return (
        x_mm - geometry.e1x_mm - half_mm - d1_mm,
        geometry.base_width_mm - x_mm - half_mm - geometry.e2x_mm - d2_mm,
    )


def forward(geometry: RobotGeometry, rho1_mm: float, rho2_mm: float) -> PlatformPosition:
    """Position of V for given actuators: the upper intersection of the two leg circles.

    Raises:
        LegsCannotCloseError: the circles do not meet, or a leg would lean outwards, which is
            another working mode than the one the robot is assembled in.
    """
    left_mm, right_mm = feet_mm(geometry, rho1_mm, rho2_mm)
    dx_mm = right_mm - left_mm
    dy_mm = geometry.e2y_mm - geometry.e1y_mm
    distance_sq = dx_mm * dx_mm + dy_mm * dy_mm
    height_sq = geometry.leg_length_mm**2 - 0.25 * distance_sq
    # "not >=" also catches NaN
    if not height_sq >= 0 or distance_sq == 0:
        msg = (
            f"rho1 = {rho1_mm:.1f} mm and rho2 = {rho2_mm:.1f} mm leave the leg feet "
            f"{math.sqrt(distance_sq):.1f} mm apart; the legs bridge more than 0 and at most "
            f"{2 * geometry.leg_length_mm:.1f} mm"
        )
        raise LegsCannotCloseError(msg, {"rho1_mm": rho1_mm, "rho2_mm": rho2_mm})
    rise = math.sqrt(height_sq / distance_sq)
    along_mm = 0.5 * dx_mm - rise * dy_mm
    # along_mm is d1; the same step seen from the other foot is d2
    if along_mm < 0 or dx_mm - along_mm < 0:
        msg = (
            f"rho1 = {rho1_mm:.1f} mm and rho2 = {rho2_mm:.1f} mm would make a leg lean outwards; "
            "the robot is not assembled that way"
        )
        raise LegsCannotCloseError(msg, {"rho1_mm": rho1_mm, "rho2_mm": rho2_mm})
    return PlatformPosition(left_mm + along_mm, geometry.e1y_mm + 0.5 * dy_mm + rise * dx_mm)


def velocity_matrices(legs: LegVectors) -> tuple[Array, Array]:
    """Matrices of the velocity equation A (xdot, ydot)^T = B (rho1dot, rho2dot)^T, both (2, 2).

    A = [[d1, h1], [-d2, h2]], B = diag(d1, d2) [mm]: the derivatives of the two constraints.
    """
    d1, h1, d2, h2 = legs
    return np.array([[d1, h1], [-d2, h2]]), np.array([[d1, 0.0], [0.0, d2]])


def jacobian(legs: LegVectors) -> Array:
    """J with (xdot, ydot)^T = J (rho1dot, rho2dot)^T, shape (2, 2), dimensionless: A^-1 B.

    Raises:
        LegsCannotCloseError: the legs are aligned (d1 h2 + d2 h1 = 0), so no J exists.
    """
    d1, h1, d2, h2 = legs
    det = d1 * h2 + d2 * h1
    if det == 0:
        msg = "the legs are folded flat: the actuators cannot drive the platform there"
        raise LegsCannotCloseError(msg)
    return np.array([[h2 * d1, -h1 * d2], [d2 * d1, d1 * d2]]) / det


def inverse_many(geometry: RobotGeometry, v_mm: Array) -> Array:
    """Actuator positions of many platform positions, joint limits not considered.

    Args:
        geometry: The robot.
        v_mm: Platform positions (x, y) in the base frame, shape (..., 2) [mm].

    Returns:
        (rho1, rho2), shape (..., 2) [mm]; NaN where `inverse` would raise.
    """
    x, y = v_mm[..., 0], v_mm[..., 1]
    h1, h2 = y - geometry.e1y_mm, y - geometry.e2y_mm
    length_sq = geometry.leg_length_mm**2
    with np.errstate(invalid="ignore"):
        d1, d2 = np.sqrt(length_sq - h1 * h1), np.sqrt(length_sq - h2 * h2)
        upper = d1 * h2 + d2 * h1 >= 0
    half_mm = 0.5 * geometry.platform_width_mm
    rho = np.stack(
        (
            x - geometry.e1x_mm - half_mm - d1,
            geometry.base_width_mm - x - half_mm - geometry.e2x_mm - d2,
        ),
        axis=-1,
    )
    rho[~upper] = np.nan
    return rho


def forward_many(geometry: RobotGeometry, rho_mm: Array) -> Array:
    """Platform positions of many actuator positions.

    Args:
        geometry: The robot.
        rho_mm: (rho1, rho2), shape (..., 2) [mm].

    Returns:
        (x, y) of V in the base frame, shape (..., 2) [mm]; NaN where `forward` would raise.
    """
    half_mm = 0.5 * geometry.platform_width_mm
    left = geometry.e1x_mm + half_mm + rho_mm[..., 0]
    dx = geometry.base_width_mm - geometry.e2x_mm - half_mm - rho_mm[..., 1] - left
    dy = geometry.e2y_mm - geometry.e1y_mm
    with np.errstate(invalid="ignore", divide="ignore"):
        distance_sq = dx * dx + dy * dy
        rise = np.sqrt((geometry.leg_length_mm**2 - 0.25 * distance_sq) / distance_sq)
        along = 0.5 * dx - rise * dy
        inwards = (along >= 0) & (dx - along >= 0)
        v = np.stack((left + along, geometry.e1y_mm + 0.5 * dy + rise * dx), axis=-1)
    v[~inwards] = np.nan
    return v
