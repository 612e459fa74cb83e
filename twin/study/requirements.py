"""The paper's requirements (a) to (k), each checked as far as the model of the robot goes."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from pydantic import Field

from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import LegsCannotCloseError, UnreachableError, alpha, gamma
from twin.kinematics.alpha import PlatformPosition
from twin.statics import LoadCase, Loads, SagTables
from twin.statics.loads import platform_push_n, slide_thrust_n
from twin.study.demands import Demands, Frozen
from twin.workspace import (
    EmptyRegionError,
    Measure,
    PlanarForce,
    TipBox,
    WorkspaceError,
    tip_box_margins,
    usable_region,
    worst_over,
)


class PaperRequirements(Frozen):
    """The figures of the paper; the greatest of a tolerance is what must still work."""

    force_n: float = Field(80.0, description="70 +-10 N, insertion and withdrawal")
    depth_mm: tuple[float, float] = Field((40.0, 20.0), description="nominal, least allowed")
    distance_mm: float = Field(20.0, description="20 (+10) mm from plug to socket")
    box_mm: tuple[float, float, float] = (200.0, 200.0, 20.0)
    accuracy_mm: float = Field(0.6, description="0.5 +-0.1 mm")
    cable_length_mm: float = Field(1500.0, description="1500 (+500) mm")
    cable_mass_kg: float = Field(1.85, description="1.4 (+0.45) kg")
    plug_diameter_mm: tuple[float, float] = (60.0, 70.0)
    robot_mass_kg: float = Field(15.0, description="10 (+5) kg")
    occupied_mm: tuple[float, float] = Field((1500.0, 200.0), description="width, height")


class Outcome(StrEnum):
    """Whether a requirement is met."""

    MET = "met"
    NOT_MET = "not_met"
    NOT_DECIDABLE = "not_decidable"


class Requirement(Frozen):
    """One requirement and what the model says about it."""

    key: str = Field(description="a to k; the letters are ours, the order is the paper's")
    subject: str
    required: str
    figure: str = Field(description="what the robot has")
    outcome: Outcome
    reason: str


@dataclass(frozen=True, slots=True)
class _Checker:
    geometry: RobotGeometry
    demands: Demands
    paper: PaperRequirements

    def force(self) -> tuple[str, Outcome, str]:
        loads = self._loads(force_n=self.paper.force_n)
        return self._carried(loads, "the largest forces over the regular box, in every case")

    def depth(self) -> tuple[str, Outcome, str]:
        nominal, least = self.paper.depth_mm
        reached = self._free_travel_mm() - self.paper.distance_mm
        reason = f"slide travel less the depth of the box and {self.paper.distance_mm:g} mm before"
        if least <= reached < nominal:
            reason += "; less than nominal, but in the tolerance"
        return f"{reached:.1f} mm", _met(reached >= least), reason

    def distance(self) -> tuple[str, Outcome, str]:
        left = self._free_travel_mm() - self.paper.depth_mm[0]
        return (
            f"up to {left:.1f} mm",
            _met(left >= self.paper.distance_mm),
            f"slide travel less the depth of the box and {self.paper.depth_mm[0]:g} mm inserted",
        )

    def box(self) -> tuple[str, Outcome, str]:
        width, height, depth = self.paper.box_mm
        center = TipBox.regular(self.geometry).center
        margins = tip_box_margins(self.geometry, TipBox(center, width, height, depth))
        state = "left" if margins.fits else "missing"
        return (
            f"{abs(margins.smallest_mm):.1f} mm {state}",
            _met(margins.fits),
            "about the centre of the regular box, decided exactly; the least way to any limit",
        )

    def freedom(self) -> tuple[str, Outcome, str]:
        box = self.geometry.regular_box
        try:
            rho = alpha.inverse(self.geometry, PlatformPosition(box.center_x_mm, box.center_y_mm))
            joints = JointPosition(*rho, self.geometry.rho3.min_mm)
            rank = int(np.linalg.matrix_rank(gamma.jacobian(self.geometry, joints)))
        except (UnreachableError, LegsCannotCloseError) as error:
            return "none", Outcome.NOT_MET, f"no pose in the middle of the regular box: {error}"
        return f"{rank}", _met(rank == 3), "rank of the Jacobian in the middle of the regular box"

    def accuracy(self) -> tuple[str, Outcome, str]:
        tables = SagTables()
        reason = "camera, calibration and play are not in it: run `plugpilot simulate campaign`"
        if not tables.are_of(self.geometry):
            return "-", Outcome.NOT_DECIDABLE, f"no deflection is published for it; {reason}"
        values = [sag_mm for _, sag_mm in tables.nine_points]
        figure = f"sag {max(values):.2f} mm, varies by {max(values) - min(values):.3f} mm"
        return figure, Outcome.NOT_DECIDABLE, f"the even part of the sag is taught away; {reason}"

    def cable_length(self) -> tuple[str, Outcome, str]:
        geometry, box = self.geometry, TipBox.regular(self.geometry)
        half = (0.5 * box.width_mm, 0.5 * box.height_mm, 0.5 * box.depth_mm)
        middle = (0.5 * geometry.base_width_mm, geometry.e1y_mm, 0.0)
        away = math.hypot(
            *(abs(c - m) + h for c, m, h in zip(box.center, middle, half, strict=True))
        )
        return (
            f"{away:.0f} mm",
            Outcome.NOT_DECIDABLE,
            "straight from the middle of the rail to the farthest plug; "
            "where the cable is held is not in the model",
        )

    def cable_mass(self) -> tuple[str, Outcome, str]:
        loads = self._loads(cable_mass_kg=self.paper.cable_mass_kg)
        share = f"with {100 * loads.cable_share:g} % of it on the plug"
        return self._carried(loads, f"{share}, over the regular box, in every case")

    def plug_diameter(self) -> tuple[str, Outcome, str]:
        low, high = self.paper.plug_diameter_mm
        diameter = self.geometry.plug_diameter_mm
        return f"{diameter:g} mm", _met(low <= diameter <= high), "as configured"

    def mass(self) -> tuple[str, Outcome, str]:
        loads = self.demands.loads
        moving = loads.platform_mass_kg + loads.slide_mass_kg + 3 * loads.bar_mass_kg
        return (
            f"{moving:.1f} kg move",
            Outcome.NOT_DECIDABLE,
            "estimated masses; rail, carriages and their motors are not in the model",
        )

    def occupied(self) -> tuple[str, Outcome, str]:
        geometry = self.geometry
        wide, high = self.paper.occupied_mm
        width = geometry.base_width_mm + max(-geometry.e2x_mm, 0.0) - min(geometry.e1x_mm, 0.0)
        try:
            lowest = usable_region(geometry, self.demands.singularity).extent.y_min_mm
        except EmptyRegionError:
            return f"{width:.0f} mm wide", Outcome.NOT_MET, "every pose is too near a singularity"
        plug = gamma.tip_offset(geometry, geometry.rho3.min_mm)[0] + 0.5 * geometry.plug_diameter_mm
        top = max(lowest, lowest + plug, geometry.e1y_mm, geometry.e2y_mm)
        bottom = min(geometry.e1y_mm, geometry.e2y_mm, geometry.e1y_mm + geometry.e_py_mm)
        height = top - bottom
        return (
            f"{width:.0f} x {height:.0f} mm",
            _met(width <= wide and height <= high),
            "parked in the lowest pose that is off the singularities; thickness of parts on top",
        )

    def _free_travel_mm(self) -> float:
        """Travel of the slide that the box of targets leaves for distance and insertion [mm]."""
        depth = self.paper.box_mm[2]
        return self.geometry.rho3.stroke_mm - depth / math.cos(self.geometry.theta_rad)

    def _loads(self, *, force_n: float | None = None, cable_mass_kg: float | None = None) -> Loads:
        loads = self.demands.loads
        forces = {} if force_n is None else dict.fromkeys(_FORCES, force_n)
        cable = {} if cable_mass_kg is None else {"cable_mass_kg": cable_mass_kg}
        return loads.model_copy(update={**forces, **cable})

    def _carried(self, loads: Loads, reason: str) -> tuple[str, Outcome, str]:
        """Whether the actuators carry loads anywhere in the regular box."""
        limits = self.demands.limits
        thrust = max(abs(slide_thrust_n(self.geometry, loads, case)) for case in LoadCase)
        platform = tip_box_margins(self.geometry, TipBox.regular(self.geometry)).platform
        carriages = [0.0, 0.0]
        try:
            for case in LoadCase:
                push = PlanarForce(0.0, platform_push_n(self.geometry, loads, case))
                for number, measure in enumerate((Measure.FORCE1, Measure.FORCE2)):
                    found = worst_over(self.geometry, platform, measure, push)
                    worst = max(abs(found.least.value), abs(found.greatest.value))
                    carriages[number] = max(carriages[number], worst)
        except WorkspaceError as error:
            return f"slide {thrust:.0f} N", Outcome.NOT_MET, f"the carriages: {error}"
        figure = (
            f"slide {thrust:.0f} of {limits.rho3_n:g} N, "
            f"carriages {max(carriages):.0f} of {min(limits.rho1_n, limits.rho2_n):g} N"
        )
        met = (
            thrust <= limits.rho3_n
            and carriages[0] <= limits.rho1_n
            and carriages[1] <= limits.rho2_n
        )
        return figure, _met(met), reason


_FORCES = ("insertion_force_n", "withdrawal_force_n")


def _met(condition: bool) -> Outcome:
    return Outcome.MET if condition else Outcome.NOT_MET


def check_requirements(
    geometry: RobotGeometry,
    demands: Demands | None = None,
    paper: PaperRequirements | None = None,
) -> tuple[Requirement, ...]:
    """The table of requirements for one robot.

    Args:
        geometry: The robot.
        demands: Its loads, the limits of its actuators, and how near a singularity it may go.
        paper: What is required.
    """
    checker = _Checker(geometry, demands or Demands(), paper or PaperRequirements())
    rows: tuple[tuple[str, str, Callable[[], tuple[str, Outcome, str]]], ...] = (
        ("insertion and withdrawal force", "70 +-10 N", checker.force),
        ("insertion depth", "40 +-20 mm", checker.depth),
        ("distance before insertion", "20 (+10) mm", checker.distance),
        ("workspace", "200 x 200 x 20 mm", checker.box),
        ("degrees of freedom", "3", checker.freedom),
        ("location accuracy", "0.5 +-0.1 mm", checker.accuracy),
        ("cable length", "1500 (+500) mm", checker.cable_length),
        ("cable mass", "1.4 (+0.45) kg", checker.cable_mass),
        ("plug diameter", "65 +-5 mm", checker.plug_diameter),
        ("robot mass", "10 (+5) kg", checker.mass),
        ("occupied space", "1500 x 200 mm", checker.occupied),
    )
    table = []
    for key, (subject, required, check) in zip("abcdefghijk", rows, strict=True):
        figure, outcome, reason = check()
        table.append(
            Requirement(
                key=key,
                subject=subject,
                required=required,
                figure=figure,
                outcome=outcome,
                reason=reason,
            )
        )
    return tuple(table)
