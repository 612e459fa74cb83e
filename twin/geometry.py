"""The numbers that describe one robot, validated, with the symbols of the published design.

Source of the symbols: D. Chablat, R. Mattacchione, E. Ottaviano, "Design of a robot for the
automatic charging of an electric car" (2022). Values the paper gives are the defaults; where it
is silent the defaults are this project's own and say so.
"""

from __future__ import annotations

import math
from typing import Annotated, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

PositiveLength = Annotated[float, Field(gt=0, le=10_000, allow_inf_nan=False)]
SignedLength = Annotated[float, Field(ge=-10_000, le=10_000, allow_inf_nan=False)]


class JointRange(BaseModel):
    """Travel of one actuator [mm]."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    min_mm: SignedLength
    max_mm: SignedLength

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        if self.max_mm <= self.min_mm:
            msg = f"max_mm ({self.max_mm:g}) must be greater than min_mm ({self.min_mm:g})"
            raise ValueError(msg)
        return self

    @property
    def stroke_mm(self) -> float:
        """Length of the travel [mm]."""
        return self.max_mm - self.min_mm

    def excess_mm(self, position_mm: float) -> float:
        """Distance by which a position lies outside the range [mm], negative below it, 0 inside.

        NaN is never inside: its excess is NaN.
        """
        if self.min_mm <= position_mm <= self.max_mm:
            return 0.0
        return position_mm - (self.min_mm if position_mm < self.min_mm else self.max_mm)


class RegularBox(BaseModel):
    """The box of plug-tip targets that the robot must serve: width x height x depth [mm].

    Its x-y centre is given for V, the midpoint of the platform. The paper asks for
    200 x 200 x 20 mm. Its x_c = 570 is the abscissa of B; V's is 570 + L3/2 = 650.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    center_x_mm: SignedLength = 650.0
    center_y_mm: SignedLength = 335.0
    width_mm: PositiveLength = 200.0
    height_mm: PositiveLength = 200.0
    depth_mm: PositiveLength = 20.0


class RobotGeometry(BaseModel):
    """Lengths, offsets and strokes of the robot gamma = alpha (planar, parallel) + beta (serial).

    alpha: A = (e1x + rho1, e1y), E = (L2 - rho2 - e2x, e2y); B, C = V -/+ (L3/2, 0);
    |AB| = |CE| = L; the left leg is a parallelogram A-B-F-D with F = V + (0, e_py).
    beta: the plug tip moves by rho3 along (0, sin theta, cos theta); e3 is the tip at rho3 = 0
    and e4 is V, both in the plane y'-z' of the slide.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    leg_length_mm: PositiveLength = Field(532.0, description="L, length of AB and CE")
    base_width_mm: PositiveLength = Field(1300.0, description="L2, distance of the rail ends")
    platform_width_mm: PositiveLength = Field(160.0, description="L3, distance of B and C")
    e1x_mm: SignedLength = Field(-25.0, description="e1x, left carriage joint at rho1 = 0")
    e1y_mm: SignedLength = Field(0.0, description="e1y, height of A")
    e2x_mm: SignedLength = Field(-25.0, description="e2x, right carriage joint at rho2 = 0")
    e2y_mm: SignedLength = Field(0.0, description="e2y, height of E")
    e_py_mm: SignedLength = Field(-80.0, description="e_py, F below V: second bar of the Pi joint")
    e3y_mm: SignedLength = Field(0.0, description="e3y, plug tip at rho3 = 0, along y'")
    e3z_mm: SignedLength = Field(150.0, description="e3z, plug tip at rho3 = 0, along z'")
    e4y_mm: SignedLength = Field(0.0, description="e4y, V in the frame of the slide")
    e4z_mm: SignedLength = Field(0.0, description="e4z, V in the frame of the slide")
    plug_diameter_mm: PositiveLength = Field(65.0, description="outer diameter of the plug")
    theta_rad: float = Field(
        math.radians(-10.0),
        gt=-math.pi / 3,
        lt=math.pi / 3,
        description="theta, inclination of the insertion axis; negative points down",
    )
    rho1: JointRange = JointRange(min_mm=0.0, max_mm=420.0)
    rho2: JointRange = JointRange(min_mm=0.0, max_mm=420.0)
    rho3: JointRange = JointRange(min_mm=50.0, max_mm=150.0)
    regular_box: RegularBox = RegularBox()

    @property
    def insertion_axis(self) -> tuple[float, float, float]:
        """Unit vector of the insertion axis in the base frame: (0, sin theta, cos theta)."""
        return (0.0, math.sin(self.theta_rad), math.cos(self.theta_rad))

    @property
    def joint_ranges(self) -> tuple[JointRange, JointRange, JointRange]:
        """Travel of rho1, rho2, rho3."""
        return (self.rho1, self.rho2, self.rho3)

    @model_validator(mode="after")
    def _legs_can_close(self) -> Self:
        """Both carriages at the start of their strokes must leave the legs a common point.

        The lowest V lies where the legs are flattest: their feet are then
        L2 - e1x - e2x - L3 - rho1 - rho2 apart and must be nearer than 2 L somewhere.
        """
        span = self.base_width_mm - self.e1x_mm - self.e2x_mm - self.platform_width_mm
        closest = span - self.rho1.max_mm - self.rho2.max_mm
        rise = abs(self.e1y_mm - self.e2y_mm)
        if math.hypot(max(closest, 0.0), rise) >= 2 * self.leg_length_mm:
            msg = (
                f"the legs never meet: with L = {self.leg_length_mm:g} mm they bridge less than "
                f"{2 * self.leg_length_mm:g} mm, but their feet stay at least "
                f"{math.hypot(max(closest, 0.0), rise):g} mm apart; lengthen leg_length_mm or the "
                "strokes"
            )
            raise ValueError(msg)
        if span - self.rho1.min_mm - self.rho2.min_mm <= 0:
            msg = (
                "the carriages cross: base_width_mm - e1x_mm - e2x_mm - platform_width_mm must "
                f"leave room between them, but is {span:g} mm"
            )
            raise ValueError(msg)
        return self
