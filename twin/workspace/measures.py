"""How well the legs drive the platform, as functions of its height.

At a given height both legs are what they are wherever the platform stands along the rail: d =
sqrt(L^2 - h^2). The determinant, the Jacobian and everything that follows from them therefore
depend on y alone, and a map of them has equal rows.

With D = d1 h2 + d2 h1 the Jacobian of alpha is J = [[h2 d1, -h1 d2], [d1 d2, d1 d2]] / D
(`twin.kinematics.alpha.jacobian`) and the carriages carry tau = J^T f
(`twin.statics.alpha_actuator_forces`).
"""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple

import numpy as np

from twin.geometry import RobotGeometry
from twin.workspace.boundary import Array
from twin.workspace.planar_force import PlanarForce

NO_FORCE = PlanarForce()


class Measure(StrEnum):
    """What can be mapped.

    Attributes:
        DETERMINANT: d1 h2 + d2 h1 [mm^2], 0 where the legs are in line (parallel singularity).
        CONDITION: Condition number of J, 1 where all directions are alike, infinite on a
            singularity.
        D1: d1 [mm], 0 where the left leg stands upright (serial singularity).
        D2: d2 [mm], likewise for the right leg.
        PARALLELOGRAM_AREA: Area of A-B-F-D [mm^2], which its stiffness follows.
        FORCE1: Force of the left carriage [N], positive towards growing rho1.
        FORCE2: Force of the right carriage [N].
        SPEED_MIN: Least speed of V for carriages moving with sqrt(v1^2 + v2^2) = 1.
        SPEED_MAX: Greatest such speed.
    """

    DETERMINANT = "determinant"
    CONDITION = "condition"
    D1 = "d1"
    D2 = "d2"
    PARALLELOGRAM_AREA = "parallelogram_area"
    FORCE1 = "force1"
    FORCE2 = "force2"
    SPEED_MIN = "speed_min"
    SPEED_MAX = "speed_max"


class _Legs(NamedTuple):
    d1: Array
    h1: Array
    d2: Array
    h2: Array
    det: Array


def measure_rows(
    geometry: RobotGeometry, measure: Measure, y_mm: Array, force: PlanarForce = NO_FORCE
) -> Array:
    """A measure at many heights of V.

    Args:
        geometry: The robot.
        measure: Which.
        y_mm: Heights, any shape.
        force: What the platform exerts; only the forces of the carriages depend on it.

    Returns:
        The same shape; NaN where the legs do not reach, or on the other assembly side; infinite
        on a singularity where the measure is.
    """
    legs = _legs_at(geometry, y_mm)
    with np.errstate(divide="ignore", invalid="ignore"):
        values = _values(geometry, measure, legs, force)
    return np.where(legs.det >= 0, values, np.nan)


def _legs_at(geometry: RobotGeometry, y_mm: Array) -> _Legs:
    h1, h2 = y_mm - geometry.e1y_mm, y_mm - geometry.e2y_mm
    with np.errstate(invalid="ignore"):
        d1 = np.sqrt(geometry.leg_length_mm**2 - h1 * h1)
        d2 = np.sqrt(geometry.leg_length_mm**2 - h2 * h2)
    return _Legs(d1, h1, d2, h2, d1 * h2 + d2 * h1)


def _values(geometry: RobotGeometry, measure: Measure, legs: _Legs, force: PlanarForce) -> Array:
    d1, h1, d2, h2, det = legs
    match measure:
        case Measure.DETERMINANT:
            return det
        case Measure.D1:
            return d1
        case Measure.D2:
            return d2
        case Measure.PARALLELOGRAM_AREA:
            return np.abs(0.5 * geometry.platform_width_mm * h1 - geometry.e_py_mm * d1)
        case Measure.FORCE1:
            return d1 * (h2 * force.x_n + d2 * force.y_n) / det
        case Measure.FORCE2:
            return d2 * (d1 * force.y_n - h1 * force.x_n) / det
        case Measure.SPEED_MIN:
            # the product of both singular values of J is d1 d2 / D
            return d1 * d2 / _greatest_singular_value(legs)
        case Measure.SPEED_MAX:
            return _greatest_singular_value(legs) / det
        case Measure.CONDITION:
            return _greatest_singular_value(legs) ** 2 / (d1 * d2 * det)


def _greatest_singular_value(legs: _Legs) -> Array:
    """Of N = D J [mm^2]: the root of the greater eigenvalue of N N^T."""
    d1, h1, d2, h2, _ = legs
    xx = (h2 * d1) ** 2 + (h1 * d2) ** 2
    yy = 2 * (d1 * d2) ** 2
    xy = d1 * d2 * (h2 * d1 - h1 * d2)
    greatest: Array = np.sqrt(0.5 * (xx + yy + np.hypot(xx - yy, 2 * xy)))
    return greatest
