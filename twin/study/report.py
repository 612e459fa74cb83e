"""What a study of a robot says, as plain numbers: the schema of `plugpilot workspace --json`.

Lengths are millimetres in the base frame, forces newtons. Positions are those of V, the midpoint
of the platform, in the wall plane, unless the name says tip.
"""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import BaseModel, ConfigDict, Field

from twin.geometry import RobotGeometry
from twin.statics import LoadCase, SagValidity
from twin.study.requirements import Requirement
from twin.workspace import Limit, Rectangle, StrokeMargins

PointMm = Annotated[tuple[float, float], Field(description="[x, y] in the wall plane [mm]")]


def side_mm(rectangle: Rectangle) -> float | None:
    """The side of a square [mm]; None for another rectangle."""
    return rectangle.width_mm if rectangle.width_mm == rectangle.height_mm else None


class Part(BaseModel):
    """A part of the report: never changed, no infinite number in it."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class StrokeMarginsMm(Part):
    """Stroke left [mm]; negative is missing."""

    rho1_min: float = Field(description="before rho1 is at the start of its stroke")
    rho1_max: float = Field(description="before rho1 is at the end of its stroke")
    rho2_min: float = Field(description="before rho2 is at the start of its stroke")
    rho2_max: float = Field(description="before rho2 is at the end of its stroke")

    @classmethod
    def of(cls, margins: StrokeMargins) -> Self:
        """Those of some positions."""
        return cls(
            rho1_min=margins.rho1_min.value_mm,
            rho1_max=margins.rho1_max.value_mm,
            rho2_min=margins.rho2_min.value_mm,
            rho2_max=margins.rho2_max.value_mm,
        )


class Corner(Part):
    """A corner of the regular square."""

    position_mm: PointMm
    rho1_mm: float | None = Field(description="null where the legs do not reach")
    rho2_mm: float | None
    margins_mm: StrokeMarginsMm | None


class AtPlace(Part):
    """A worst value and where it is."""

    value: float
    at_mm: PointMm


class RegularSquare(Part):
    """The square that the robot must serve: the face of its regular box."""

    side_mm: float | None = Field(description="null if the box is not a square")
    width_mm: float
    height_mm: float
    center_mm: PointMm
    fits: bool
    margins_mm: StrokeMarginsMm = Field(description="the least over the whole square")
    above_folded_mm: float = Field(description="height left above the legs in line")
    below_upright_mm: float = Field(description="height left below a leg standing upright")
    corners: tuple[Corner, ...] = Field(description="lower left, then counterclockwise")


class LargestSquare(Part):
    """The largest square in the workspace."""

    side_mm: float
    center_mm: PointMm
    contacts: tuple[Limit, ...] = Field(description="limits that it touches")


class Placements(Part):
    """All centres that the regular square can have."""

    side_mm: float | None = Field(description="null if the box is not a square")
    width_mm: float
    height_mm: float
    area_mm2: float
    boundary: tuple[PointMm, ...] = Field(
        description="closed polyline, within 0.05 mm of the exact arcs; empty if it fits nowhere"
    )


class BoundaryPiece(Part):
    """An exact piece of the workspace's boundary; a straight one has no centre and no radius."""

    limit: Limit
    start_mm: PointMm
    end_mm: PointMm
    center_mm: PointMm | None
    radius_mm: float | None


class ActuatorForce(Part):
    """The largest static force of one actuator over the regular square."""

    case: LoadCase
    actuator: str
    force_n: float = Field(description="positive towards growing rho")
    limit_n: float
    margin_n: float
    at_mm: PointMm | None = Field(description="null where the place does not matter")


class BoxReport(Part):
    """The box of plug-tip positions."""

    width_mm: float
    height_mm: float
    depth_mm: float
    tip_center_mm: tuple[float, float, float]
    fits: bool
    margins_mm: StrokeMarginsMm
    rho3_min_mm: float = Field(description="stroke left before rho3 is at its start")
    rho3_max_mm: float = Field(description="stroke left before rho3 is at its end")
    deepest_mm: float | None = Field(description="depth that fits about the same centre")


class LameReport(Part):
    """The paper's Lame curve in place of the regular square, beside the exact answer."""

    exponent: int
    margins_mm: StrokeMarginsMm = Field(description="of all positions that the curve encloses")
    fits: bool
    exact_fits: bool
    largest_side_mm: float = Field(description="that the curve finds about the same centre")
    exact_side_mm: float = Field(description="that really fits there")
    overstated_mm: float


class PaperConditions(Part):
    """For which offsets and strokes (from 0) the paper's square is inside, with its L, L2, L3."""

    reading: str = Field(description="how its x_c = 570 is read")
    center_mm: PointMm = Field(description="of V")
    e1x_max_mm: float = Field(description="e1x is at most this")
    e1x_plus_s1_min_mm: float = Field(description="e1x + s1 is at least this")
    e2x_max_mm: float
    e2x_plus_s2_min_mm: float
    s1_min_mm: float = Field(description="so this is the least stroke")
    s2_min_mm: float
    met: bool | None = Field(
        description="by the robot studied; null if its L, L2, L3, e1y or e2y are not the paper's"
    )


class DeflectionReport(Part):
    """Largest displacement under self-weight over the regular square, from the paper's tables."""

    alpha_mm: float
    beta_mm: float
    validity: SagValidity


class StudyReport(Part):
    """The whole study of one robot."""

    geometry: RobotGeometry
    area_mm2: float = Field(description="of the workspace of V")
    boundary: tuple[BoundaryPiece, ...] = Field(description="of the workspace, counterclockwise")
    largest_square: LargestSquare
    regular_square: RegularSquare
    placements: Placements
    worst_condition: AtPlace | None = Field(
        description="condition number over the regular square; null where it is outside or singular"
    )
    largest_force: ActuatorForce | None = Field(
        description="of the actuator nearest to its limit; null where the square is outside"
    )
    forces: tuple[ActuatorForce, ...]
    box: BoxReport
    lame: tuple[LameReport, ...] = Field(
        description="only for a square box whose centre is in the workspace"
    )
    paper: tuple[PaperConditions, ...]
    deflection: DeflectionReport | None = Field(
        description="null where the regular square is outside"
    )
    requirements: tuple[Requirement, ...]
