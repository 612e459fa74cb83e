"""The result of a search as plain numbers.

The schema of `plugpilot workspace --optimise --json`.
"""

from __future__ import annotations

import math
from typing import Self

from pydantic import Field

from twin.geometry import RobotGeometry
from twin.study.demands import Demand
from twin.study.optimise import Objective, Optimum
from twin.study.report import Part
from twin.study.verdict import Verdict


class CheckReport(Part):
    """One demand, what the start had and what the result has."""

    demand: Demand
    limit: float
    at_most: bool = Field(description="the limit is the greatest value allowed, else the least")
    unit: str
    start: float | None = Field(description="null where the robot has no pose to measure")
    start_passed: bool
    found: float
    passed: bool
    binding: bool = Field(description="without this demand there would be a smaller robot")


class SearchReport(Part):
    """The smallest robot that was found."""

    objective: Objective
    unit: str
    value: float = Field(description="of the objective, for the robot found")
    start_value: float = Field(description="for the robot that the search started from")
    start_passed: bool = Field(description="that one meets all demands")
    seed: int
    checks: tuple[CheckReport, ...]
    geometry: RobotGeometry

    @classmethod
    def of(cls, found: Optimum, seed: int) -> Self:
        """The report of a search."""
        return cls(
            objective=found.objective,
            unit=found.objective.unit,
            value=found.value,
            start_value=found.start_value,
            start_passed=found.start_verdict.passed,
            seed=seed,
            checks=_checks(found.start_verdict, found.verdict, found.binding),
            geometry=found.geometry,
        )


def _checks(start: Verdict, found: Verdict, binding: tuple[Demand, ...]) -> tuple[CheckReport, ...]:
    return tuple(
        CheckReport(
            demand=after.demand,
            limit=after.limit,
            at_most=after.at_most,
            unit=after.unit,
            start=None if math.isnan(before.value) else before.value,
            start_passed=before.passed,
            found=after.value,
            passed=after.passed,
            binding=after.demand in binding,
        )
        for before, after in zip(start.checks, found.checks, strict=True)
    )
