"""The planar mechanism as it was built: legs, feet, rails and belts each with its own numbers.

The foot of the left leg, shifted by the half platform as in `twin.kinematics.alpha`, runs along a
rail that may be skewed, and the belt may stretch:

    F1 = O1 + k1 rho1 (cos a1, sin a1),    F2 = O2 - k2 rho2 (cos a2, sin a2)

and V is where the circles of radius L1 about F1 and of radius L2 about F2 meet on the car's side:

    g1 = |V - F1|^2 - L1^2 = 0,    g2 = |V - F2|^2 - L2^2 = 0.

Half the platform belongs to O1 and O2: no motion of this robot tells L3 / 2 from e1x or e2x. The
platform still only translates; a parallelogram with unequal bars would turn it by its posture,
and that is not in this model.
"""

from __future__ import annotations

import math
from typing import Annotated, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field

from twin.geometry import PositiveLength, RobotGeometry, SignedLength
from twin.kinematics import LegsCannotCloseError, PlatformPosition, alpha

Array = NDArray[np.float64]
SkewAngle = Annotated[float, Field(ge=-0.2, le=0.2, allow_inf_nan=False)]
BeltScale = Annotated[float, Field(ge=0.8, le=1.25, allow_inf_nan=False)]


class PlanarAsBuilt(BaseModel):
    """Ten numbers of one built robot; `as_drawn` gives those of the drawing."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    left_leg_mm: PositiveLength = Field(description="L1, length of AB")
    right_leg_mm: PositiveLength = Field(description="L2, length of CE")
    left_foot_x_mm: SignedLength = Field(description="O1, left foot + L3/2 at rho1 = 0, along x")
    left_foot_y_mm: SignedLength = Field(description="O1, along y")
    right_foot_x_mm: SignedLength = Field(description="O2, right foot - L3/2 at rho2 = 0, along x")
    right_foot_y_mm: SignedLength = Field(description="O2, along y")
    left_rail_rad: SkewAngle = Field(0.0, description="a1, left rail against the x axis")
    right_rail_rad: SkewAngle = Field(0.0, description="a2, right rail against the x axis")
    left_scale: BeltScale = Field(1.0, description="k1, true travel over the board's rho1")
    right_scale: BeltScale = Field(1.0, description="k2, true travel over the board's rho2")

    @classmethod
    def as_drawn(cls, geometry: RobotGeometry) -> Self:
        """The robot of the drawing."""
        left_mm, right_mm = alpha.feet_mm(geometry, 0.0, 0.0)
        return cls(
            left_leg_mm=geometry.leg_length_mm,
            right_leg_mm=geometry.leg_length_mm,
            left_foot_x_mm=left_mm,
            left_foot_y_mm=geometry.e1y_mm,
            right_foot_x_mm=right_mm,
            right_foot_y_mm=geometry.e2y_mm,
        )

    @classmethod
    def from_vector(cls, values: Array) -> Self:
        """From numbers in the order of `PARAMETERS`, shape (10,)."""
        return cls(**dict(zip(PARAMETERS, map(float, values), strict=True)))

    @property
    def vector(self) -> Array:
        """The numbers in the order of `PARAMETERS`, shape (10,)."""
        return np.array([getattr(self, name) for name in PARAMETERS])

    def forward(self, rho1_mm: float, rho2_mm: float) -> PlatformPosition:
        """Position of V for given actuators, as `forward_many` finds it.

        Raises:
            LegsCannotCloseError: the legs do not reach each other.
        """
        # plain floats: a simulated robot asks this many times a second
        left_mm, right_mm = self.left_scale * rho1_mm, self.right_scale * rho2_mm
        x1 = self.left_foot_x_mm + left_mm * math.cos(self.left_rail_rad)
        y1 = self.left_foot_y_mm + left_mm * math.sin(self.left_rail_rad)
        dx = self.right_foot_x_mm - right_mm * math.cos(self.right_rail_rad) - x1
        dy = self.right_foot_y_mm - right_mm * math.sin(self.right_rail_rad) - y1
        distance_sq = dx * dx + dy * dy
        reach = self.left_leg_mm**2 / distance_sq if distance_sq else math.nan
        along = 0.5 + 0.5 * (reach - self.right_leg_mm**2 / distance_sq) if distance_sq else 0.0
        rise_sq = reach - along * along
        # "not >=" also catches NaN
        if not rise_sq >= 0:
            msg = f"rho1 = {rho1_mm:.1f} mm and rho2 = {rho2_mm:.1f} mm leave the legs too short"
            raise LegsCannotCloseError(msg, {"rho1_mm": rho1_mm, "rho2_mm": rho2_mm})
        rise = math.sqrt(rise_sq)
        return PlatformPosition(x1 + along * dx - rise * dy, y1 + along * dy + rise * dx)

    def forward_many(self, rho_mm: Array) -> Array:
        """Platform positions of many actuator positions.

        Args:
            rho_mm: (rho1, rho2) as the board counts them, shape (..., 2) [mm].

        Returns:
            (x, y) of V in the base frame, shape (..., 2) [mm]; NaN where the legs cannot close.
        """
        left, right = self._feet(rho_mm)
        between = right - left
        distance_sq = np.sum(between**2, axis=-1)
        with np.errstate(invalid="ignore", divide="ignore"):
            along = 0.5 + 0.5 * (self.left_leg_mm**2 - self.right_leg_mm**2) / distance_sq
            rise = np.sqrt(self.left_leg_mm**2 / distance_sq - along**2)
        across = np.stack((-between[..., 1], between[..., 0]), axis=-1)
        v: Array = left + along[..., None] * between + rise[..., None] * across
        return v

    def inverse_many(self, v_mm: Array) -> Array:
        """Actuator positions of many platform positions, joint limits not considered.

        With w the way from the rail's zero to V, split into a part p along the rail and a part h
        across it, the carriage stands sqrt(L^2 - h^2) behind V.

        Args:
            v_mm: (x, y) of V in the base frame, shape (..., 2) [mm].

        Returns:
            (rho1, rho2) as the board counts them, shape (..., 2) [mm]; NaN where the legs are too
            short.
        """
        rho = []
        for origin, rail, leg_mm, scale in self._sides:
            from_zero = v_mm - origin
            along = from_zero @ rail
            across_sq = np.sum(from_zero**2, axis=-1) - along**2
            with np.errstate(invalid="ignore"):
                rho.append((along - np.sqrt(leg_mm**2 - across_sq)) / scale)
        return np.stack(rho, axis=-1)

    def jacobians_many(self, rho_mm: Array) -> Array:
        """J with (xdot, ydot)^T = J (rho1dot, rho2dot)^T, dimensionless.

        A leg only turns, so that l . Vdot = l . Fdot for each of both.

        Args:
            rho_mm: (rho1, rho2), shape (..., 2) [mm].

        Returns:
            Shape (..., 2, 2); NaN where the legs cannot close.
        """
        v = self.forward_many(rho_mm)
        legs = np.stack([v - foot for foot in self._feet(rho_mm)], axis=-2)
        along = np.stack(
            [
                scale * (legs[..., side, :] @ rail)
                for side, (_, rail, _, scale) in enumerate(self._sides)
            ],
            axis=-1,
        )
        return np.asarray(np.linalg.solve(legs, along[..., None] * np.eye(2)))

    def derivatives_many(self, rho_mm: Array, v_mm: Array) -> Array:
        """How V changes with each of the ten numbers, the actuators held.

        Differentiating g1 and g2 gives, with the legs l1 = V - F1 and l2 = V - F2,

            l1 . dV = l1 . dF1 + L1 dL1,    l2 . dV = l2 . dF2 + L2 dL2.

        Args:
            rho_mm: (rho1, rho2), shape (n, 2) [mm].
            v_mm: V at these, shape (n, 2) [mm].

        Returns:
            dV by the numbers in the order of `PARAMETERS`, shape (n, 2, 10).
        """
        count = len(rho_mm)
        legs = np.stack([v_mm - foot for foot in self._feet(rho_mm)], axis=1)
        right_side = np.zeros((count, 2, len(PARAMETERS)))
        for side, (_, rail, leg_mm, scale) in enumerate(self._sides):
            leg, travel_mm = legs[:, side], rho_mm[:, side]
            turned = np.array([-rail[1], rail[0]])
            right_side[:, side, 0 + side] = leg_mm
            right_side[:, side, 2 + 2 * side : 4 + 2 * side] = leg
            right_side[:, side, 6 + side] = scale * travel_mm * (leg @ turned)
            right_side[:, side, 8 + side] = travel_mm * (leg @ rail)
        return np.asarray(np.linalg.solve(legs, right_side))

    @property
    def _sides(self) -> tuple[tuple[Array, Array, float, float], ...]:
        """Of each side: foot at zero, direction of growing rho, leg, belt."""
        left, right = self.left_rail_rad, self.right_rail_rad
        return (
            (
                np.array([self.left_foot_x_mm, self.left_foot_y_mm]),
                np.array([np.cos(left), np.sin(left)]),
                self.left_leg_mm,
                self.left_scale,
            ),
            (
                np.array([self.right_foot_x_mm, self.right_foot_y_mm]),
                -np.array([np.cos(right), np.sin(right)]),
                self.right_leg_mm,
                self.right_scale,
            ),
        )

    def _feet(self, rho_mm: Array) -> tuple[Array, Array]:
        """Feet of both legs, shape (..., 2) each."""
        left, right = (
            origin + scale * rho_mm[..., side, None] * rail
            for side, (origin, rail, _, scale) in enumerate(self._sides)
        )
        return left, right


PARAMETERS = tuple(PlanarAsBuilt.model_fields)
"""Names of the ten numbers, in the order of their vector."""
