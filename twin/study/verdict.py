"""The exact test of one robot against the demands."""

from __future__ import annotations

import math
from dataclasses import dataclass

from twin.geometry import RobotGeometry
from twin.statics import LoadCase
from twin.statics.loads import platform_push_n, slide_thrust_n
from twin.study.demands import Demand, Demands
from twin.workspace import (
    Measure,
    PlanarForce,
    Rectangle,
    TipBox,
    WorkspaceError,
    tip_box_margins,
    worst_over,
)

ROUNDING = 1e-9


@dataclass(frozen=True, slots=True)
class Check:
    """One demand on one robot.

    Attributes:
        demand: Which.
        value: What the robot has; NaN where it has no pose to measure.
        limit: What is demanded.
        at_most: The limit is the greatest value allowed; else the least.
        unit: Of both, "" for a ratio.
    """

    demand: Demand
    value: float
    limit: float
    at_most: bool
    unit: str

    @property
    def passed(self) -> bool:
        """The demand is met; never by NaN."""
        slack = self.limit - self.value if self.at_most else self.value - self.limit
        return slack >= -ROUNDING * max(1.0, abs(self.limit))


def _at_least(demand: Demand, value: float, limit: float, unit: str = "") -> Check:
    return Check(demand, value, limit, at_most=False, unit=unit)


def _at_most(demand: Demand, value: float, limit: float, unit: str = "") -> Check:
    return Check(demand, value, limit, at_most=True, unit=unit)


@dataclass(frozen=True, slots=True)
class Verdict:
    """All demands on one robot."""

    checks: tuple[Check, ...]

    @property
    def passed(self) -> bool:
        """All of them are met."""
        return all(check.passed for check in self.checks)

    @property
    def missed(self) -> tuple[Demand, ...]:
        """Those that are not."""
        return tuple(check.demand for check in self.checks if not check.passed)


def worst_push(geometry: RobotGeometry, demands: Demands) -> tuple[LoadCase, float]:
    """The load case with the largest push on the platform along y, and that push [N]."""
    pushes = {case: platform_push_n(geometry, demands.loads, case) for case in LoadCase}
    case = max(pushes, key=lambda name: abs(pushes[name]))
    return case, pushes[case]


def verify(geometry: RobotGeometry, demands: Demands) -> Verdict:
    """Whether a robot serves its regular box as demanded, decided exactly.

    The stroke left is the least over the whole box of the plug tip; condition number, forces and
    measures of singularity are the worst over the platform positions that the box asks for.
    """
    margins = tip_box_margins(geometry, TipBox.regular(geometry))
    plane = margins.plane
    strokes = (plane.rho1_min, plane.rho1_max, plane.rho2_min, plane.rho2_max)
    length = geometry.leg_length_mm
    thrust_n = max(abs(slide_thrust_n(geometry, demands.loads, case)) for case in LoadCase)
    limits = demands.limits
    return Verdict(
        (
            _at_least(Demand.LEG_LENGTH, plane.leg_length.value_mm, 0.0, "mm"),
            _at_least(Demand.ABOVE_CARRIAGES, plane.assembly_side.value_mm, 0.0, "mm"),
            _at_least(
                Demand.STROKE, min(left.value_mm for left in strokes), demands.margin_mm, "mm"
            ),
            _at_least(
                Demand.SLIDE_TRAVEL,
                margins.rho3_min_mm + margins.rho3_max_mm,
                demands.insertion_travel_mm,
                "mm",
            ),
            _at_most(Demand.SLIDE_FORCE, thrust_n, limits.rho3_n, "N"),
            *_over_the_rows(geometry, demands, margins.platform, length),
        )
    )


def _over_the_rows(
    geometry: RobotGeometry, demands: Demands, platform: Rectangle, length_mm: float
) -> tuple[Check, ...]:
    _, push_n = worst_push(geometry, demands)
    force = PlanarForce(0.0, push_n)

    def least(measure: Measure) -> float:
        try:
            return worst_over(geometry, platform, measure, force).least.value
        except WorkspaceError:
            return math.nan

    def greatest(measure: Measure) -> float:
        try:
            extremes = worst_over(geometry, platform, measure, force)
        except WorkspaceError:
            return math.nan
        return max(abs(extremes.least.value), abs(extremes.greatest.value))

    singularity, limits = demands.singularity, demands.limits
    bar_mm = math.hypot(0.5 * geometry.platform_width_mm, geometry.e_py_mm)
    return (
        _at_most(Demand.CONDITION, greatest(Measure.CONDITION), demands.max_condition),
        _at_most(
            Demand.CARRIAGE_FORCE,
            max(greatest(Measure.FORCE1), greatest(Measure.FORCE2)),
            min(limits.rho1_n, limits.rho2_n),
            "N",
        ),
        _at_least(Demand.PARALLEL, least(Measure.DETERMINANT) / length_mm**2, singularity.parallel),
        _at_least(
            Demand.SERIAL, min(least(Measure.D1), least(Measure.D2)) / length_mm, singularity.serial
        ),
        _at_least(
            Demand.PARALLELOGRAM,
            least(Measure.PARALLELOGRAM_AREA) / (length_mm * bar_mm),
            singularity.parallelogram,
        ),
    )
