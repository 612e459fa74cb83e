"""How far the robot sags under its own weight, from the published finite element results.

Source: D. Chablat, R. Mattacchione, E. Ottaviano, "Design of a robot for the automatic charging of
an electric car" (2022): largest displacement at nine points of the regular square for the
planar robot alpha, and at five positions of the slide for beta. The numbering of the nine points
is in a figure that is not printed with the tables; here they run row by row from the corner
nearest the origin: along the rail first, then away from it.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import gamma

Displacement = Annotated[float, Field(ge=0, le=100, allow_inf_nan=False)]
Row = tuple[Displacement, Displacement, Displacement]


class SagTables(BaseModel):
    """Largest displacement under self-weight [mm]; the defaults are the paper's.

    Attributes:
        alpha_mm: At the corners, edge middles and centre of the regular box, three rows of three,
            from the corner nearest the origin, along x first.
        beta_rho3_mm: Slide positions of the second table, ascending.
        beta_mm: At those slide positions.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    alpha_mm: tuple[Row, Row, Row] = (
        (0.995, 0.993, 0.991),
        (0.990, 0.996, 0.989),
        (1.030, 1.010, 1.030),
    )
    beta_rho3_mm: tuple[float, ...] = (50.0, 75.0, 100.0, 125.0, 150.0)
    beta_mm: tuple[Displacement, ...] = (1.080, 0.996, 0.936, 0.907, 0.958)

    @model_validator(mode="after")
    def _paired_and_ascending(self) -> Self:
        if len(self.beta_mm) != len(self.beta_rho3_mm) or len(self.beta_mm) < 2:
            msg = "beta_mm and beta_rho3_mm must have the same length, at least 2"
            raise ValueError(msg)
        if any(b <= a for a, b in pairwise(self.beta_rho3_mm)):
            msg = "beta_rho3_mm must ascend"
            raise ValueError(msg)
        return self


@dataclass(frozen=True, slots=True)
class Sag:
    """Largest displacement under self-weight at one pose [mm].

    Attributes:
        alpha_mm: Of the planar robot.
        beta_mm: Of the slide.
        within_table: Whether the pose lies inside both tables. Outside, the nearest value of the
            table stands in, because the tables do not support extrapolation.
    """

    alpha_mm: float
    beta_mm: float
    within_table: bool

    @property
    def bound_mm(self) -> float:
        """Bound of both together: they need not point the same way, nor lie in the same spot."""
        return self.alpha_mm + self.beta_mm


DEFAULT_TABLES = SagTables()


def sag(geometry: RobotGeometry, joints: JointPosition, tables: SagTables = DEFAULT_TABLES) -> Sag:
    """Sag at a pose: bilinear in the platform position over the regular box, linear in rho3.

    Raises:
        LegsCannotCloseError: no pose has these joints.
    """
    v = gamma.platform(geometry, joints)
    box = geometry.regular_box
    columns = _axis(box.center_x_mm, box.width_mm)
    rows = _axis(box.center_y_mm, box.height_mm)
    x_index, x_share, x_inside = _place(columns, v.x_mm)
    y_index, y_share, y_inside = _place(rows, v.y_mm)
    low, high = (
        row[x_index] + x_share * (row[x_index + 1] - row[x_index])
        for row in tables.alpha_mm[y_index : y_index + 2]
    )
    index, share, inside = _place(tables.beta_rho3_mm, joints.rho3_mm)
    beta_mm = tables.beta_mm[index] + share * (tables.beta_mm[index + 1] - tables.beta_mm[index])
    return Sag(low + y_share * (high - low), beta_mm, x_inside and y_inside and inside)


def _axis(center_mm: float, size_mm: float) -> tuple[float, float, float]:
    return (center_mm - 0.5 * size_mm, center_mm, center_mm + 0.5 * size_mm)


def _place(knots: Sequence[float], value: float) -> tuple[int, float, bool]:
    """Interval of ascending knots, share of the way through it, and whether it holds the value."""
    index = min(max(bisect_right(knots, value) - 1, 0), len(knots) - 2)
    share = (value - knots[index]) / (knots[index + 1] - knots[index])
    return index, min(max(share, 0.0), 1.0), knots[0] <= value <= knots[-1]
