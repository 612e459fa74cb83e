"""The joints as functions of the distance along a straight line of the plug tip.

The tip is P(s) = P0 + s u with a unit vector u. Its platform moves by ux along the rail and
climbs by vy = uy - uz tan(theta) per distance, its slide by uz / cos(theta). With h the height of
a leg and w = sqrt(L^2 - h^2) its reach along the rail, each carriage has

    q' = +-ux + vy h / w,   q'' = vy^2 L^2 / w^3,   q''' = 3 vy^3 L^2 h / w^5.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple, Self

import numpy as np

from twin.geometry import RobotGeometry
from twin.joints import JointPosition, TipPosition
from twin.kinematics import gamma
from twin.motion.plan import Array


class PathDerivatives(NamedTuple):
    """First three derivatives of the joint positions by the distance s, one value per joint."""

    first: tuple[float, float, float]
    second: tuple[float, float, float]
    third: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class TipLine:
    """A line segment of the plug tip, with its joints.

    Attributes:
        leg_sq_mm2: L^2.
        rho1_at_zero_reach_mm: rho1 plus the reach of the left leg, at s = 0.
        rho2_at_zero_reach_mm: rho2 plus the reach of the right leg, at s = 0.
        h1_mm: Height of the platform above the left carriage at s = 0.
        h2_mm: Height of the platform above the right carriage at s = 0.
        rho3_mm: rho3 at s = 0.
        ux: Travel of the platform along the rail per distance.
        vy: Climb of the platform per distance.
        slide: Travel of the slide per distance.
        length_mm: Length of the line.
    """

    leg_sq_mm2: float
    rho1_at_zero_reach_mm: float
    rho2_at_zero_reach_mm: float
    h1_mm: float
    h2_mm: float
    rho3_mm: float
    ux: float
    vy: float
    slide: float
    length_mm: float

    @classmethod
    def between(cls, geometry: RobotGeometry, start: JointPosition, target: TipPosition) -> Self:
        """The line from the tip at given joints to a target.

        Raises:
            LegsCannotCloseError: no pose has the start joints.
        """
        v = gamma.platform(geometry, start)
        tip = gamma.forward(geometry, start)
        step = (target.x_mm - tip.x_mm, target.y_mm - tip.y_mm, target.z_mm - tip.z_mm)
        length_mm = math.hypot(*step)
        ux, uy, uz = (part / length_mm for part in step) if length_mm > 0 else (0.0, 0.0, 0.0)
        leg_sq_mm2 = geometry.leg_length_mm**2
        h1_mm, h2_mm = v.y_mm - geometry.e1y_mm, v.y_mm - geometry.e2y_mm
        return cls(
            leg_sq_mm2=leg_sq_mm2,
            rho1_at_zero_reach_mm=start.rho1_mm + math.sqrt(leg_sq_mm2 - h1_mm * h1_mm),
            rho2_at_zero_reach_mm=start.rho2_mm + math.sqrt(leg_sq_mm2 - h2_mm * h2_mm),
            h1_mm=h1_mm,
            h2_mm=h2_mm,
            rho3_mm=start.rho3_mm,
            ux=ux,
            vy=uy - uz * math.tan(geometry.theta_rad),
            slide=uz / math.cos(geometry.theta_rad),
            length_mm=length_mm,
        )

    def joints_at(self, s_mm: float) -> JointPosition:
        """Joint positions at a distance along the line [mm]."""
        climb_mm = self.vy * s_mm
        reach1_mm = math.sqrt(self.leg_sq_mm2 - (self.h1_mm + climb_mm) ** 2)
        reach2_mm = math.sqrt(self.leg_sq_mm2 - (self.h2_mm + climb_mm) ** 2)
        return JointPosition(
            self.rho1_at_zero_reach_mm + self.ux * s_mm - reach1_mm,
            self.rho2_at_zero_reach_mm - self.ux * s_mm - reach2_mm,
            self.rho3_mm + self.slide * s_mm,
        )

    def derivatives_at(self, s_mm: float) -> PathDerivatives:
        """Derivatives of the joints at a distance along the line; infinite at zero reach."""
        one = self._leg_derivatives(self.h1_mm + self.vy * s_mm)
        two = self._leg_derivatives(self.h2_mm + self.vy * s_mm)
        return PathDerivatives(
            (self.ux + one[0], -self.ux + two[0], self.slide),
            (one[1], two[1], 0.0),
            (one[2], two[2], 0.0),
        )

    def largest_derivatives(self) -> PathDerivatives:
        """Largest magnitudes of the derivatives anywhere on the line.

        h is linear in s; h/w, L^2/w^3 and h L^2/w^5 are monotonic in h on each side of h = 0, and
        their magnitudes grow with |h|. So the largest magnitudes stand at the two ends.
        """
        ends = (self.derivatives_at(0.0), self.derivatives_at(self.length_mm))
        first, second, third = (
            tuple(max(abs(a), abs(b)) for a, b in zip(*order, strict=True))
            for order in zip(*ends, strict=True)
        )
        return PathDerivatives(
            (first[0], first[1], first[2]),
            (second[0], second[1], second[2]),
            (third[0], third[1], third[2]),
        )

    def sample(self, s_mm: Array) -> tuple[Array, Array, Array]:
        """Joint positions [mm] and their first and second derivatives, each of shape (N, 3)."""
        legs = [self._sample_leg(h_mm + self.vy * s_mm) for h_mm in (self.h1_mm, self.h2_mm)]
        (reach1, slope1, curve1), (reach2, slope2, curve2) = legs
        zero = np.zeros_like(s_mm)
        return (
            np.column_stack(
                (
                    self.rho1_at_zero_reach_mm + self.ux * s_mm - reach1,
                    self.rho2_at_zero_reach_mm - self.ux * s_mm - reach2,
                    self.rho3_mm + self.slide * s_mm,
                )
            ),
            np.column_stack((self.ux + slope1, -self.ux + slope2, zero + self.slide)),
            np.column_stack((curve1, curve2, zero)),
        )

    def _leg_derivatives(self, h_mm: float) -> tuple[float, float, float]:
        """Derivatives of minus the reach of a leg whose height is h."""
        reach_sq = self.leg_sq_mm2 - h_mm * h_mm
        if reach_sq <= 0:
            return (math.inf, math.inf, math.inf) if self.vy else (0.0, 0.0, 0.0)
        reach = math.sqrt(reach_sq)
        return (
            self.vy * h_mm / reach,
            self.vy**2 * self.leg_sq_mm2 / reach**3,
            3 * self.vy**3 * self.leg_sq_mm2 * h_mm / reach**5,
        )

    def _sample_leg(self, h_mm: Array) -> tuple[Array, Array, Array]:
        reach = np.sqrt(self.leg_sq_mm2 - h_mm * h_mm)
        return reach, self.vy * h_mm / reach, self.vy**2 * self.leg_sq_mm2 / reach**3
