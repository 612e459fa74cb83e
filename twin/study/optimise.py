"""The smallest robot that does what is demanded; NoDesignError says that there is none."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from itertools import product

import numpy as np
from numpy.typing import NDArray

from twin.errors import TwinError
from twin.geometry import RobotGeometry
from twin.study.candidates import RESOLUTION_MM, Candidates, Designer
from twin.study.demands import SEARCHED, Demand, Demands, SearchBounds
from twin.study.evolution import Scores, best_of, evolve
from twin.study.verdict import Verdict, verify

Array = NDArray[np.float64]

GENERATIONS = 120

NEARNESS = 1e-6
"""Weight of the distance from the lengths of the start, in objective per mm: among designs that
are equally small the most familiar one is taken."""


class Objective(StrEnum):
    """What is to be made small."""

    AREA = "area"
    """Wall area that the robot takes while it serves the box: width times height [mm^2]."""

    WIDTH = "width"
    """Width of the rail with what stands out beyond its ends [mm]."""

    BASE_WIDTH = "base_width"
    """L2 alone [mm]."""

    @property
    def unit(self) -> str:
        """Of its value."""
        return "mm2" if self is Objective.AREA else "mm"


class NoDesignError(TwinError):
    """No robot within the bounds meets the demands.

    Attributes:
        missed: The demands that the nearest design misses, the most excessive first, with their
            relative excess.
        binding: The demands of which each, dropped alone, would make a design possible.
    """

    code = "no_design"
    remedy = "Relax a demand that is named, or widen the bounds of the search."

    def __init__(
        self, message: str, missed: dict[Demand, float], binding: tuple[Demand, ...]
    ) -> None:
        super().__init__(message)
        self.missed = missed
        self.binding = binding


@dataclass(frozen=True, slots=True)
class Optimum:
    """The smallest robot that was found.

    Attributes:
        geometry: The robot, its regular box where it serves best.
        objective: What was made small.
        value: Of the objective.
        start_value: Of the objective for the robot that the search started from.
        start_verdict: Whether that one meets the demands.
        verdict: The exact test of the design: all margins, passed.
        binding: The demands that keep it from being smaller: without them it would be.
    """

    geometry: RobotGeometry
    objective: Objective
    value: float
    start_value: float
    start_verdict: Verdict
    verdict: Verdict
    binding: tuple[Demand, ...]


def occupied_size_mm(geometry: RobotGeometry) -> tuple[float, float]:
    """Width and height of the wall area between the outermost pivots and rail ends [mm].

    Counted while the plug tip is in the regular box, from the lowest pivot on the rail to the
    highest V; the thickness of the parts comes on top.
    """
    width_mm = max(geometry.base_width_mm, geometry.base_width_mm - geometry.e2x_mm) - min(
        0.0, geometry.e1x_mm
    )
    lowest_mm = min(geometry.e1y_mm, geometry.e2y_mm, geometry.e1y_mm + geometry.e_py_mm)
    box = geometry.regular_box
    platform_mm = box.height_mm + box.depth_mm * abs(math.tan(geometry.theta_rad))
    return width_mm, box.center_y_mm + 0.5 * platform_mm - lowest_mm


def value_of(geometry: RobotGeometry, objective: Objective) -> float:
    """The objective of one robot, in its unit."""
    if objective is Objective.BASE_WIDTH:
        return geometry.base_width_mm
    width_mm, height_mm = occupied_size_mm(geometry)
    return width_mm if objective is Objective.WIDTH else width_mm * height_mm


class _Search:
    def __init__(
        self,
        designer: Designer,
        objective: Objective,
        seed: int,
        on_generation: Callable[[], None],
    ) -> None:
        self._designer = designer
        self._objective = objective
        self._seed = seed
        self._on_generation = on_generation

    def run(self, dropped: frozenset[Demand] = frozenset()) -> Candidates:
        """The best design, alone in its arrays; no length one step away makes it better."""
        designer = self._designer
        point = evolve(
            lambda points: self._scores(designer.complete(designer.lengths(points)), dropped),
            len(SEARCHED),
            seed=self._seed,
            generations=GENERATIONS,
            on_generation=self._on_generation,
        )
        lengths = designer.lengths(point[np.newaxis])[0]
        while True:
            near = self._neighbours(lengths)
            best = best_of(self._scores(designer.complete(near), dropped))
            if best == 0:
                return designer.complete(lengths[np.newaxis])
            lengths = near[best]

    def values(self, found: Candidates) -> Array:
        """The objective of many designs, shape (N,)."""
        if self._objective is Objective.BASE_WIDTH:
            return found.base_width_mm
        base = self._designer.base
        right = found.base_width_mm + np.maximum(-found.e2x_mm, 0.0)
        width: Array = right - np.minimum(found.e1x_mm, 0.0)
        if self._objective is Objective.WIDTH:
            return width
        lowest = min(base.e1y_mm, base.e2y_mm, base.e1y_mm + base.e_py_mm)
        top = found.box_center_y_mm + 0.5 * self._designer.platform_height_mm
        return width * (top - lowest)

    def _scores(self, found: Candidates, dropped: frozenset[Demand]) -> Scores:
        values = self.values(found)
        kept = [np.maximum(e, 0.0) for name, e in found.excess.items() if name not in dropped]
        start = self._designer.start()
        lengths = np.stack([getattr(found, name) for name in SEARCHED], axis=-1)
        return Scores(
            values + NEARNESS * np.abs(lengths - start).sum(axis=-1), np.sum(kept, axis=0)
        )

    def _neighbours(self, lengths: Array) -> Array:
        """The design itself, then all that lie one or ten steps away in one or two lengths."""
        low = np.array([b.low_mm for b in self._designer.bounds.searched])
        high = np.array([b.high_mm for b in self._designer.bounds.searched])
        single = [step * row for row in np.eye(len(SEARCHED)) for step in (-10, -1, 1, 10)]
        moves = [np.zeros(len(SEARCHED)), *single]
        moves += [a + b for a, b in product(single, single)]
        near: Array = np.clip(lengths + RESOLUTION_MM * np.array(moves), low, high)
        return near


def optimise(
    base: RobotGeometry,
    demands: Demands | None = None,
    bounds: SearchBounds | None = None,
    *,
    objective: Objective = Objective.AREA,
    seed: int = 0,
    on_step: Callable[[int, int], None] = lambda done, total: None,  # noqa: ARG005
) -> Optimum:
    """Smallest robot that serves a box.

    Args:
        base: Where the search starts; what is not searched is taken from it.
        demands: What the robot must be able to do.
        bounds: How far the lengths may be varied.
        objective: What is to be made small.
        seed: The same seed finds the same robot.
        on_step: Called with the steps done and their number, for a progress bar.

    Raises:
        NoDesignError: no robot within the bounds meets the demands; says which are missed.
    """
    demands, bounds = demands or Demands(), bounds or SearchBounds()
    designer = Designer(base, demands, bounds)
    counter = _Counter(on_step, GENERATIONS * (1 + len(DROPPABLE)))
    search = _Search(designer, objective, seed, counter.step)
    fixed = {name: excess for name, excess in designer.fixed_excess().items() if excess > 0}
    if fixed:
        raise _no_design(fixed, {})
    found = search.run()
    missed = {name: float(e[0]) for name, e in found.excess.items() if e[0] > 0}
    without = {name: search.run(frozenset({name})) for name in DROPPABLE}
    counter.finish()
    if missed:
        raise _no_design(missed, without)
    value = float(search.values(found)[0])
    binding = tuple(
        name for name, other in without.items() if float(search.values(other)[0]) < value - 1e-9
    )
    geometry = designer.geometry(found)
    verdict = verify(geometry, demands)
    if not verdict.passed:
        msg = f"the search and the exact test disagree about {geometry!r}: {verdict.missed}"
        raise AssertionError(msg)
    return Optimum(
        geometry,
        objective,
        value_of(geometry, objective),
        value_of(base, objective),
        verify(_with_box(base, demands), demands),
        verdict,
        binding,
    )


DROPPABLE = (
    Demand.CONDITION,
    Demand.CARRIAGE_FORCE,
    Demand.PARALLEL,
    Demand.SERIAL,
    Demand.PARALLELOGRAM,
    Demand.BASE_WIDTH,
    Demand.STROKE,
)
"""Demands without which a robot could still be built."""


class _Counter:
    def __init__(self, on_step: Callable[[int, int], None], total: int) -> None:
        self._on_step = on_step
        self._done = 0
        self._total = total

    def step(self) -> None:
        self._done += 1
        self._on_step(self._done, self._total)

    def finish(self) -> None:
        self._on_step(self._total, self._total)


def _with_box(base: RobotGeometry, demands: Demands) -> RobotGeometry:
    """The robot with the demanded box about the centre of its own."""
    size = {"width_mm": demands.width_mm, "height_mm": demands.height_mm}
    box = base.regular_box.model_copy(update={**size, "depth_mm": demands.depth_mm})
    return base.model_copy(update={"regular_box": box})


def _no_design(missed: dict[Demand, float], without: dict[Demand, Candidates]) -> NoDesignError:
    worst_first = dict(sorted(missed.items(), key=lambda item: -item[1]))
    binding = tuple(
        name
        for name, other in without.items()
        if all(float(e[0]) <= 0 for demand, e in other.excess.items() if demand is not name)
    )
    lacking = ", ".join(f"{name} by {100 * excess:.1f} %" for name, excess in worst_first.items())
    msg = f"no robot within the bounds meets the demands; the nearest one exceeds {lacking}"
    if binding:
        msg += f"; without the demand on {' or on '.join(binding)} there is one"
    return NoDesignError(msg, worst_first, binding)
