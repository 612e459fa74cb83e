"""Velocity and force ellipses of the platform at one position.

Carriage velocities on the unit circle make the platform's velocities J u: an ellipse with the
singular values of J as semi-axes, along its left singular vectors. Carriage forces tau on the unit
circle make the platform push with f = J^-T tau: the same axes with the reciprocal values.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from twin.geometry import RobotGeometry
from twin.kinematics import NearSingularityError, PlatformPosition, alpha
from twin.workspace.boundary import Array
from twin.workspace.worst import SINGULAR


@dataclass(frozen=True, slots=True)
class Ellipse:
    """An ellipse about the origin.

    Attributes:
        semi_major: Longer semi-axis.
        semi_minor: Shorter semi-axis.
        angle_rad: Direction of the longer one from the x axis, in (-pi/2, pi/2].
    """

    semi_major: float
    semi_minor: float
    angle_rad: float

    def points(self, count: int) -> Array:
        """Points of the ellipse, shape (count, 2); the last one is the first."""
        turn = np.linspace(0, 2 * np.pi, count)
        along = self.semi_major * np.cos(turn)
        across = self.semi_minor * np.sin(turn)
        cosine, sine = math.cos(self.angle_rad), math.sin(self.angle_rad)
        return np.column_stack((cosine * along - sine * across, sine * along + cosine * across))


def velocity_ellipse(geometry: RobotGeometry, v: PlatformPosition) -> Ellipse:
    """Velocities of V for carriage velocities with v1^2 + v2^2 = 1 (dimensionless).

    Raises:
        UnreachableError: the legs do not reach V; joint limits are not considered.
        LegsCannotCloseError: the legs are folded flat.
    """
    axes, values, _ = np.linalg.svd(_jacobian(geometry, v))
    return _ellipse(axes[:, 0], values[0], values[1])


def force_ellipse(geometry: RobotGeometry, v: PlatformPosition) -> Ellipse:
    """Forces that the platform exerts for carriage forces with tau1^2 + tau2^2 = 1.

    Raises:
        UnreachableError: the legs do not reach V; joint limits are not considered.
        LegsCannotCloseError: the legs are folded flat.
        NearSingularityError: a leg stands upright, where a force costs its carriage nothing.
    """
    axes, values, _ = np.linalg.svd(_jacobian(geometry, v))
    if values[1] < SINGULAR:
        msg = f"a leg stands upright at y = {v.y_mm:.1f} mm: the force there has no bound"
        raise NearSingularityError(msg, measure="serial", value=float(values[1]), minimum=SINGULAR)
    return _ellipse(axes[:, 1], 1 / values[1], 1 / values[0])


def _jacobian(geometry: RobotGeometry, v: PlatformPosition) -> Array:
    return alpha.jacobian(alpha.leg_vectors(geometry, v, *alpha.inverse(geometry, v)))


def _ellipse(direction: Array, semi_major: float, semi_minor: float) -> Ellipse:
    angle = math.atan2(direction[1], direction[0])
    if angle <= -0.5 * math.pi or angle > 0.5 * math.pi:
        angle -= math.copysign(math.pi, angle)
    return Ellipse(float(semi_major), float(semi_minor), angle)
