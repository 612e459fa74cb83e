"""Kinematics of gamma, the assembled robot: from the three joints to the plug tip P and back.

    X = x,   Y = y + y' - e4y,   Z = z' - e4z

with V = (x, y) from alpha and (y', z') from beta. Z depends on rho3 alone, so the inverse takes
rho3 from Z first and then asks alpha for the rest.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from twin.geometry import RobotGeometry
from twin.joints import JointPosition, TipPosition
from twin.kinematics import alpha, beta
from twin.kinematics.alpha import PlatformPosition
from twin.kinematics.errors import UnreachableError, UnreachableReason

Array = NDArray[np.float64]

JOINT_NAMES = ("rho1", "rho2", "rho3")

LIMIT_TOLERANCE_MM = 1e-6
"""Rounding of the square roots: a joint this far beyond its limit still counts as on it."""


def platform(geometry: RobotGeometry, joints: JointPosition) -> PlatformPosition:
    """Position of V [mm].

    Raises:
        LegsCannotCloseError: no pose of the assembled robot has these joints.
    """
    return alpha.forward(geometry, joints.rho1_mm, joints.rho2_mm)


def tip_offset(geometry: RobotGeometry, rho3_mm: float) -> tuple[float, float]:
    """(y, z) from V to the plug tip in the base frame [mm]."""
    y_mm, z_mm = beta.forward(geometry, rho3_mm)
    return y_mm - geometry.e4y_mm, z_mm - geometry.e4z_mm


def platform_for_tip(geometry: RobotGeometry, tip: TipPosition) -> tuple[PlatformPosition, float]:
    """Position of V [mm] and rho3 [mm] that put the plug tip at a point; legs not considered.

    rho3 = (Z + e4z - e3z) / cos(theta);   y = Y + e4y - e3y - rho3 sin(theta);   x = X
    """
    rho3_mm = (tip.z_mm + geometry.e4z_mm - geometry.e3z_mm) / math.cos(geometry.theta_rad)
    y_mm = tip.y_mm + geometry.e4y_mm - geometry.e3y_mm - rho3_mm * math.sin(geometry.theta_rad)
    return PlatformPosition(tip.x_mm, y_mm), rho3_mm


def forward(geometry: RobotGeometry, joints: JointPosition) -> TipPosition:
    """Position of the plug tip in the base frame [mm].

    Raises:
        LegsCannotCloseError: no pose of the assembled robot has these joints.
    """
    x_mm, y_mm = alpha.forward(geometry, joints.rho1_mm, joints.rho2_mm)
    dy_mm, z_mm = tip_offset(geometry, joints.rho3_mm)
    return TipPosition(x_mm, y_mm + dy_mm, z_mm)


def inverse_unlimited(geometry: RobotGeometry, tip: TipPosition) -> JointPosition:
    """Joint positions [mm] that put the plug tip at a point, joint limits not considered.

    Raises:
        UnreachableError: the legs are too short, or the platform would be on the wrong side.
    """
    v, rho3_mm = platform_for_tip(geometry, tip)
    rho1_mm, rho2_mm = alpha.inverse(geometry, v)
    return JointPosition(rho1_mm, rho2_mm, rho3_mm)


def inverse(geometry: RobotGeometry, tip: TipPosition) -> JointPosition:
    """Joint positions [mm] within their limits that put the plug tip at a point.

    Raises:
        UnreachableError: the legs are too short, the platform would be on the wrong side, or
            joints would leave their limits; the sentence says which and by how much.
    """
    joints = inverse_unlimited(geometry, tip)
    check_joint_limits(geometry, joints)
    return joints


def check_joint_limits(
    geometry: RobotGeometry, joints: JointPosition, *, tolerance_mm: float = LIMIT_TOLERANCE_MM
) -> None:
    """Do nothing if all joints are within their travel.

    Raises:
        UnreachableError: names every joint beyond a limit; its fields tell the worst one.
    """
    worst_name, worst_mm, worst_limit_mm = "", 0.0, 0.0
    clauses: list[str] = []
    for name, value_mm, travel in zip(JOINT_NAMES, joints, geometry.joint_ranges, strict=True):
        excess_mm = travel.excess_mm(value_mm)
        if abs(excess_mm) <= tolerance_mm:
            continue
        side, kind = ("below", "lower") if excess_mm < 0 else ("above", "upper")
        limit_mm = travel.min_mm if excess_mm < 0 else travel.max_mm
        clauses.append(
            f"{name} would have to be {value_mm:.1f} mm, {abs(excess_mm):.1f} mm {side} its "
            f"{kind} limit of {limit_mm:g} mm"
        )
        if abs(excess_mm) > abs(worst_mm):
            worst_name, worst_mm, worst_limit_mm = name, excess_mm, limit_mm
    if not clauses:
        return
    raise UnreachableError(
        ", and ".join(clauses),
        reason=(
            UnreachableReason.BELOW_JOINT_LIMIT
            if worst_mm < 0
            else UnreachableReason.ABOVE_JOINT_LIMIT
        ),
        joint=worst_name,
        limit_mm=worst_limit_mm,
        excess_mm=abs(worst_mm),
    )


def jacobian(geometry: RobotGeometry, joints: JointPosition) -> Array:
    """J with (Xdot, Ydot, Zdot)^T = J (rho1dot, rho2dot, rho3dot)^T, shape (3, 3).

    Raises:
        LegsCannotCloseError: no pose has these joints, or the legs are folded flat.
    """
    v = platform(geometry, joints)
    matrix = np.zeros((3, 3))
    matrix[:2, :2] = alpha.jacobian(alpha.leg_vectors(geometry, v, joints.rho1_mm, joints.rho2_mm))
    matrix[:, 2] = geometry.insertion_axis
    return matrix


def forward_many(geometry: RobotGeometry, joints_mm: Array) -> Array:
    """Plug tips of many joint positions.

    Args:
        geometry: The robot.
        joints_mm: (rho1, rho2, rho3), shape (..., 3) [mm].

    Returns:
        (X, Y, Z) in the base frame, shape (..., 3) [mm]; NaN where `forward` would raise.
    """
    v = alpha.forward_many(geometry, joints_mm[..., :2])
    _, sine, cosine = geometry.insertion_axis
    rho3 = joints_mm[..., 2]
    y = v[..., 1] + (geometry.e3y_mm - geometry.e4y_mm) + rho3 * sine
    z = (geometry.e3z_mm - geometry.e4z_mm) + rho3 * cosine
    tips = np.stack((v[..., 0], y, z), axis=-1)
    tips[np.isnan(v[..., 0])] = np.nan
    return tips


def inverse_many(geometry: RobotGeometry, tips_mm: Array) -> Array:
    """Joint positions of many plug tips, joint limits not considered.

    Args:
        geometry: The robot.
        tips_mm: (X, Y, Z) in the base frame, shape (..., 3) [mm].

    Returns:
        (rho1, rho2, rho3), shape (..., 3) [mm]; NaN where the legs cannot reach. Ask
        `within_limits_many` for the joint limits.
    """
    _, sine, cosine = geometry.insertion_axis
    rho3 = (tips_mm[..., 2] + (geometry.e4z_mm - geometry.e3z_mm)) / cosine
    y = tips_mm[..., 1] + (geometry.e4y_mm - geometry.e3y_mm) - rho3 * sine
    rho = alpha.inverse_many(geometry, np.stack((tips_mm[..., 0], y), axis=-1))
    joints = np.concatenate((rho, rho3[..., np.newaxis]), axis=-1)
    joints[np.isnan(rho[..., 0])] = np.nan
    return joints


def within_limits_many(
    geometry: RobotGeometry, joints_mm: Array, *, tolerance_mm: float = LIMIT_TOLERANCE_MM
) -> NDArray[np.bool_]:
    """Whether all three joints are within their travel; False for NaN.

    Args:
        geometry: The robot.
        joints_mm: (rho1, rho2, rho3), shape (..., 3) [mm].
        tolerance_mm: A joint this far beyond its limit still counts as on it.

    Returns:
        Shape (...).
    """
    low = np.array([travel.min_mm for travel in geometry.joint_ranges]) - tolerance_mm
    high = np.array([travel.max_mm for travel in geometry.joint_ranges]) + tolerance_mm
    inside: NDArray[np.bool_] = np.all((joints_mm >= low) & (joints_mm <= high), axis=-1)
    return inside
