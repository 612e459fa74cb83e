"""How far the robot sags under its own weight, from the published finite element results.

Source: D. Chablat, R. Mattacchione, E. Ottaviano, "Design of a robot for the automatic charging of
an electric car" (2022): largest displacement at nine points of the regular square for the
planar robot alpha, and at five positions of the slide for beta. The numbering of the nine points
is in a figure that is not printed with the tables; here they run row by row from the corner
nearest the origin: along the rail first, then away from it.

The tables hold for one robot and between their own points. `Sag.validity` says whether they were
asked for more.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import pairwise
from typing import Annotated, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from twin.geometry import PositiveLength, RobotGeometry, SignedLength
from twin.joints import JointPosition
from twin.kinematics import gamma
from twin.kinematics.alpha import PlatformPosition

Displacement = Annotated[float, Field(ge=0, le=100, allow_inf_nan=False)]
Row = tuple[Displacement, Displacement, Displacement]
Knots = tuple[SignedLength, SignedLength, SignedLength]

SAME_ROBOT_TOLERANCE = 0.01
"""Relative difference of L, L2 and L3 up to which the tables still speak of the same robot."""


ROUNDING_MM = 1e-6
"""The edge of a table belongs to it, whatever the square roots make of it."""


class SagValidity(StrEnum):
    """What a sag is worth."""

    INTERPOLATED = "interpolated"
    """Between the points of both tables, for the robot they were computed for."""

    OUTSIDE_TABLE = "outside_table"
    """Beyond their points: the nearest value stands in, an extrapolation by a constant."""

    ANOTHER_ROBOT = "another_robot"
    """This robot has other lengths than the one of the tables."""


class SagTables(BaseModel):
    """Largest displacement under self-weight [mm]; the defaults are the paper's.

    Attributes:
        alpha_mm: At the nine points, three rows of three, from the corner nearest the origin,
            along x first.
        alpha_x_mm: Abscissae of V at those points; the paper's x_c = 570 is that of B.
        alpha_y_mm: Ordinates of V at those points.
        beta_rho3_mm: Slide positions of the second table, ascending.
        beta_mm: At those slide positions.
        leg_length_mm: L of the robot of the tables.
        base_width_mm: L2 of that robot.
        platform_width_mm: L3 of that robot.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    alpha_mm: tuple[Row, Row, Row] = (
        (0.995, 0.993, 0.991),
        (0.990, 0.996, 0.989),
        (1.030, 1.010, 1.030),
    )
    alpha_x_mm: Knots = (550.0, 650.0, 750.0)
    alpha_y_mm: Knots = (235.0, 335.0, 435.0)
    beta_rho3_mm: tuple[SignedLength, ...] = (50.0, 75.0, 100.0, 125.0, 150.0)
    beta_mm: tuple[Displacement, ...] = (1.080, 0.996, 0.936, 0.907, 0.958)
    leg_length_mm: PositiveLength = 532.0
    base_width_mm: PositiveLength = 1300.0
    platform_width_mm: PositiveLength = 160.0

    @model_validator(mode="after")
    def _paired_and_ascending(self) -> Self:
        if len(self.beta_mm) != len(self.beta_rho3_mm) or len(self.beta_mm) < 2:
            msg = "beta_mm and beta_rho3_mm must have the same length, at least 2"
            raise ValueError(msg)
        for name in ("alpha_x_mm", "alpha_y_mm", "beta_rho3_mm"):
            if any(b <= a for a, b in pairwise(getattr(self, name))):
                msg = f"{name} must ascend"
                raise ValueError(msg)
        return self

    @property
    def nine_points(self) -> tuple[tuple[PlatformPosition, float], ...]:
        """The places of V and the displacements there, in the order of the numbering."""
        return tuple(
            (PlatformPosition(x_mm, y_mm), sag_mm)
            for y_mm, row in zip(self.alpha_y_mm, self.alpha_mm, strict=True)
            for x_mm, sag_mm in zip(self.alpha_x_mm, row, strict=True)
        )

    def are_of(self, geometry: RobotGeometry) -> bool:
        """Whether the tables were computed for this robot, up to errors of its build."""
        return all(
            abs(ours - theirs) <= SAME_ROBOT_TOLERANCE * theirs
            for ours, theirs in (
                (geometry.leg_length_mm, self.leg_length_mm),
                (geometry.base_width_mm, self.base_width_mm),
                (geometry.platform_width_mm, self.platform_width_mm),
            )
        )


@dataclass(frozen=True, slots=True)
class Sag:
    """Largest displacement under self-weight at one pose [mm].

    Attributes:
        alpha_mm: Of the planar robot.
        beta_mm: Of the slide.
        validity: What the two numbers are worth.
    """

    alpha_mm: float
    beta_mm: float
    validity: SagValidity

    @property
    def bound_mm(self) -> float:
        """Bound of both together: they need not point the same way, nor lie in the same spot."""
        return self.alpha_mm + self.beta_mm


DEFAULT_TABLES = SagTables()


def sag(geometry: RobotGeometry, joints: JointPosition, tables: SagTables = DEFAULT_TABLES) -> Sag:
    """Sag at a pose: bilinear between the nine points, linear in rho3.

    Raises:
        LegsCannotCloseError: no pose has these joints.
    """
    v = gamma.platform(geometry, joints)
    x_index, x_share, x_inside = _place(tables.alpha_x_mm, v.x_mm)
    y_index, y_share, y_inside = _place(tables.alpha_y_mm, v.y_mm)
    low, high = (
        row[x_index] + x_share * (row[x_index + 1] - row[x_index])
        for row in tables.alpha_mm[y_index : y_index + 2]
    )
    index, share, inside = _place(tables.beta_rho3_mm, joints.rho3_mm)
    beta_mm = tables.beta_mm[index] + share * (tables.beta_mm[index + 1] - tables.beta_mm[index])
    if not tables.are_of(geometry):
        validity = SagValidity.ANOTHER_ROBOT
    elif x_inside and y_inside and inside:
        validity = SagValidity.INTERPOLATED
    else:
        validity = SagValidity.OUTSIDE_TABLE
    return Sag(low + y_share * (high - low), beta_mm, validity)


def _place(knots: Sequence[float], value: float) -> tuple[int, float, bool]:
    """Interval of ascending knots, share of the way through it, and whether it holds the value."""
    index = min(max(bisect_right(knots, value) - 1, 0), len(knots) - 2)
    share = (value - knots[index]) / (knots[index + 1] - knots[index])
    inside = knots[0] - ROUNDING_MM <= value <= knots[-1] + ROUNDING_MM
    return index, min(max(share, 0.0), 1.0), inside
