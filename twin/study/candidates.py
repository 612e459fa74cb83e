"""From a few searched lengths to whole robots, and what each of them lacks; many at a time.

The box fixes the rest. With d1 and d2 the reach of the legs along the rail (d^2 + h^2 = L^2), the
left carriage stands furthest out when V is in the lower left corner of the box and furthest in when
it is in the upper right one, so the least robot with a margin m has

    x_c = w/2 + L3/2 + max d1 + e1x + m,      s1 = w + max d1 - min d1 + 2 m,
    L2  = x_c + w/2 + L3/2 + max d2 + e2x + m, s2 = w + max d2 - min d2 + 2 m.

The Jacobian, and with it the condition number, the forces and the measures of singularity, depend
on the height of V alone. They are looked at in `ROWS` heights here, the lowest and the highest of
the box included; the design that wins is verified exactly.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from twin.geometry import JointRange, RegularBox, RobotGeometry
from twin.statics import LoadCase
from twin.statics.loads import platform_push_n, slide_thrust_n
from twin.study.demands import SEARCHED, Demand, Demands, SearchBounds

Array = NDArray[np.float64]

ROWS = 9

RESOLUTION_MM = 1.0
"""Designs have lengths in whole millimetres; what follows from them is rounded to the safe side."""


@dataclass(frozen=True, slots=True)
class Candidates:
    """Many designs; every array has the shape (N,)."""

    leg_length_mm: Array
    platform_width_mm: Array
    e1x_mm: Array
    e2x_mm: Array
    box_center_y_mm: Array
    box_center_x_mm: Array
    base_width_mm: Array
    stroke1_mm: Array
    stroke2_mm: Array
    excess: dict[Demand, Array]
    """Relative excess over each demand, at most 0 where it is met."""


class _Legs(NamedTuple):
    """Lengths (N,), and the legs' components in each row (N, ROWS) [mm]."""

    leg: Array
    platform: Array
    d1: Array
    h1: Array
    d2: Array
    h2: Array


class Designer:
    """Makes candidates of one search.

    Args:
        base: The robot that the search starts from; what is not searched is taken from it.
        demands: What the robot must be able to do.
        bounds: How far the lengths may be varied.
    """

    def __init__(self, base: RobotGeometry, demands: Demands, bounds: SearchBounds) -> None:
        self.base = base
        self.demands = demands
        self.bounds = bounds
        self._low = np.array([b.low_mm for b in bounds.searched])
        self._span = np.array([b.high_mm for b in bounds.searched]) - self._low
        # the tip's box leans over: V rises and falls by as much as the insertion axis does in it
        slope = abs(math.tan(base.theta_rad))
        self.platform_height_mm = demands.height_mm + demands.depth_mm * slope
        self._push_n = max(abs(platform_push_n(base, demands.loads, c)) for c in LoadCase)

    def lengths(self, points: Array) -> Array:
        """Searched lengths of points in the unit cube, rounded, shape (N, len(SEARCHED)) [mm]."""
        lengths: Array = np.round((self._low + points * self._span) / RESOLUTION_MM) * RESOLUTION_MM
        return np.clip(lengths, self._low, self._low + self._span)

    def complete(self, lengths: Array) -> Candidates:
        """Whole designs of searched lengths, shape (N, len(SEARCHED)) [mm]."""
        leg, platform, e1x, e2x, center_y = lengths.T
        base, box, margin = self.base, self.demands, self.demands.margin_mm
        y = center_y[:, np.newaxis] + np.linspace(-0.5, 0.5, ROWS) * self.platform_height_mm
        h1, h2 = y - base.e1y_mm, y - base.e2y_mm
        highest = np.maximum(np.abs(h1), np.abs(h2)).max(axis=1)
        # a leg that is too short is counted as such below; meanwhile it stands upright
        d1, d2 = (np.sqrt(np.maximum(leg[:, np.newaxis] ** 2 - h * h, 0.0)) for h in (h1, h2))
        reach1, reach2 = d1.max(axis=1), d2.max(axis=1)
        for reach, h in ((reach1, h1), (reach2, h2)):
            crosses = (h.min(axis=1) < 0) & (h.max(axis=1) > 0)
            reach[crosses] = leg[crosses]
        half = 0.5 * (box.width_mm + platform)
        center_x = _up(half + reach1 + e1x + margin)
        width = _up(center_x + half + reach2 + e2x + margin)
        stroke1 = _up(
            center_x + 0.5 * box.width_mm - 0.5 * platform - d1.min(axis=1) - e1x + margin
        )
        rest = width - center_x + 0.5 * box.width_mm - 0.5 * platform
        stroke2 = _up(rest - d2.min(axis=1) - e2x + margin)
        excess = self._excess(_Legs(leg, platform, d1, h1, d2, h2), highest)
        excess[Demand.BASE_WIDTH] = width / self.bounds.base_width_max_mm - 1
        excess[Demand.STROKE] = np.maximum(stroke1, stroke2) / self.bounds.stroke_max_mm - 1
        return Candidates(
            leg, platform, e1x, e2x, center_y, center_x, width, stroke1, stroke2, excess
        )

    def _excess(self, legs: _Legs, highest: Array) -> dict[Demand, Array]:
        """Relative excess over the demands that the legs decide."""
        demands, limits = self.demands, self.demands.limits
        leg, platform, d1, h1, d2, h2 = legs
        column = leg[:, np.newaxis]
        with np.errstate(divide="ignore", invalid="ignore"):
            det = d1 * h2 + d2 * h1
            area = np.abs(0.5 * platform[:, np.newaxis] * h1 - self.base.e_py_mm * d1)
            bar = np.hypot(0.5 * platform, self.base.e_py_mm)[:, np.newaxis]
            worst = {
                Demand.CONDITION: _condition(d1, h1, d2, h2) / demands.max_condition - 1,
                # both carriages carry the same share of a push along y
                Demand.CARRIAGE_FORCE: np.abs(self._push_n * d1 * d2 / det)
                / min(limits.rho1_n, limits.rho2_n)
                - 1,
                Demand.PARALLEL: demands.singularity.parallel - det / column**2,
                Demand.SERIAL: demands.singularity.serial - np.minimum(d1, d2) / column,
                Demand.PARALLELOGRAM: demands.singularity.parallelogram - area / (column * bar),
            }
        least_height = np.minimum(h1, h2).min(axis=1)
        excess = {name: _finite(values.max(axis=1)) for name, values in worst.items()}
        return {
            Demand.LEG_LENGTH: highest / leg - 1,
            Demand.ABOVE_CARRIAGES: -least_height / leg,
            **excess,
        }

    def fixed_excess(self) -> dict[Demand, float]:
        """Relative excess over the demands on the slide, which no searched length changes."""
        slide, demands = self.base.rho3, self.demands
        travel_mm = demands.depth_mm / math.cos(self.base.theta_rad) + demands.insertion_travel_mm
        thrust_n = max(abs(slide_thrust_n(self.base, demands.loads, case)) for case in LoadCase)
        return {
            Demand.SLIDE_TRAVEL: travel_mm / slide.stroke_mm - 1,
            Demand.SLIDE_FORCE: thrust_n / demands.limits.rho3_n - 1,
        }

    def geometry(self, found: Candidates, index: int = 0) -> RobotGeometry:
        """One candidate as a robot.

        Raises:
            ValueError: its legs cannot close.
        """
        changed = {
            "leg_length_mm": float(found.leg_length_mm[index]),
            "base_width_mm": float(found.base_width_mm[index]),
            "platform_width_mm": float(found.platform_width_mm[index]),
            "e1x_mm": float(found.e1x_mm[index]),
            "e2x_mm": float(found.e2x_mm[index]),
            "rho1": JointRange(min_mm=0.0, max_mm=float(found.stroke1_mm[index])),
            "rho2": JointRange(min_mm=0.0, max_mm=float(found.stroke2_mm[index])),
            "regular_box": RegularBox(
                center_x_mm=float(found.box_center_x_mm[index]),
                center_y_mm=float(found.box_center_y_mm[index]),
                width_mm=self.demands.width_mm,
                height_mm=self.demands.height_mm,
                depth_mm=self.demands.depth_mm,
            ),
        }
        kept = {name: getattr(self.base, name) for name in RobotGeometry.model_fields}
        return RobotGeometry.model_validate({**kept, **changed})

    def start(self) -> Array:
        """The searched lengths of the robot that the search starts from, in their order [mm]."""
        y_mm = self.base.regular_box.center_y_mm
        values = {name: getattr(self.base, name, y_mm) for name in SEARCHED}
        return np.array([values[name] for name in SEARCHED])


def _condition(d1: Array, h1: Array, d2: Array, h2: Array) -> Array:
    """Condition number of J = [[h2 d1, -h1 d2], [d1 d2, d1 d2]] / (d1 h2 + d2 h1)."""
    frobenius_sq = (h2 * d1) ** 2 + (h1 * d2) ** 2 + 2 * (d1 * d2) ** 2
    minor = d1 * d2 * np.abs(d1 * h2 + d2 * h1)
    # the singular values have the sum of squares `frobenius_sq` and the product `minor`
    root = np.sqrt(np.maximum(frobenius_sq**2 - 4 * minor**2, 0.0))
    condition: Array = (frobenius_sq + root) / (2 * minor)
    return condition


def _finite(values: Array) -> Array:
    """Singular poses count as a very large excess, so that the search still sees a direction."""
    return np.nan_to_num(np.minimum(values, 1e3), nan=1e3)


def _up(length_mm: Array) -> Array:
    rounded: Array = np.ceil(length_mm / RESOLUTION_MM - 1e-9) * RESOLUTION_MM
    return rounded
