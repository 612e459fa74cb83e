"""Forces of the actuators while the robot pushes with a given force.

By virtual work the actuator forces tau that make the tip push with a force f satisfy
tau . rhodot = f . Pdot for every motion, so tau = J^T f with the Jacobian Pdot = J rhodot. Friction
and weight are not in it. In the symmetric pose a pure fy asks fy d / (2 h) of each carriage: the
higher the platform stands, the less.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import alpha, gamma
from twin.kinematics.alpha import LegVectors
from twin.kinematics.errors import LegsCannotCloseError

Array = NDArray[np.float64]


class TipForce(NamedTuple):
    """Force that the plug tip exerts on its surroundings, in the base frame [N]."""

    x_n: float
    y_n: float
    z_n: float


class JointForces(NamedTuple):
    """Forces of the actuators [N], positive in the direction of growing rho."""

    rho1_n: float
    rho2_n: float
    rho3_n: float


def alpha_actuator_forces(legs: LegVectors, fx_n: float, fy_n: float) -> tuple[float, float]:
    """Forces of the two carriages [N] that make the platform push with (fx, fy).

    With A Vdot = B rhodot (`twin.kinematics.alpha.velocity_matrices`) the leg multipliers solve
    the transpose system A^T lambda = f, and the carriages carry tau = B lambda.

    Raises:
        LegsCannotCloseError: the legs are folded flat and carry no such force.
    """
    d1, h1, d2, h2 = legs
    det = d1 * h2 + d2 * h1
    if det == 0:
        msg = "the legs are folded flat: no actuator force holds the platform there"
        raise LegsCannotCloseError(msg)
    left = (h2 * fx_n + d2 * fy_n) / det
    right = (d1 * fy_n - h1 * fx_n) / det
    return d1 * left, d2 * right


def actuator_forces(geometry: RobotGeometry, joints: JointPosition, force: TipForce) -> JointForces:
    """Forces of the three actuators [N] that make the plug tip push with a force.

    The slide carries the component along the insertion axis; the carriages carry fx and fy in
    full, because the platform must hold what the slide passes on.

    Raises:
        LegsCannotCloseError: no pose has these joints, or the legs are folded flat.
    """
    v = gamma.platform(geometry, joints)
    legs = alpha.leg_vectors(geometry, v, joints.rho1_mm, joints.rho2_mm)
    rho1_n, rho2_n = alpha_actuator_forces(legs, force.x_n, force.y_n)
    _, axis_y, axis_z = geometry.insertion_axis
    return JointForces(rho1_n, rho2_n, force.y_n * axis_y + force.z_n * axis_z)


def alpha_actuator_forces_many(
    geometry: RobotGeometry, rho_mm: Array, fx_n: float, fy_n: float
) -> Array:
    """Forces of the two carriages at many poses that make the platform push with (fx, fy).

    Args:
        geometry: The robot.
        rho_mm: (rho1, rho2), shape (..., 2) [mm].
        fx_n: Along the rail [N].
        fy_n: Away from the rail [N].

    Returns:
        Forces [N], shape (..., 2); NaN where no pose exists or the legs are folded flat.
    """
    v = alpha.forward_many(geometry, rho_mm)
    left_mm, right_mm = alpha.feet_mm(geometry, 0.0, 0.0)
    d1, h1 = v[..., 0] - left_mm - rho_mm[..., 0], v[..., 1] - geometry.e1y_mm
    d2, h2 = right_mm - rho_mm[..., 1] - v[..., 0], v[..., 1] - geometry.e2y_mm
    det = d1 * h2 + d2 * h1
    det = np.where(det == 0, np.nan, det)
    forces: Array = np.stack(
        (d1 * (h2 * fx_n + d2 * fy_n) / det, d2 * (d1 * fy_n - h1 * fx_n) / det), axis=-1
    )
    return forces
