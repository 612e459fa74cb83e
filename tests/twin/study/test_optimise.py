from __future__ import annotations

import math

import numpy as np
import pytest

from twin.geometry import RobotGeometry
from twin.statics import ActuatorLimits
from twin.study.analyse import study
from twin.study.candidates import Designer
from twin.study.demands import Bounds, Demand, Demands, SearchBounds
from twin.study.optimise import NoDesignError, Objective, Optimum, occupied_size_mm, optimise
from twin.study.verdict import verify
from twin.workspace import Rectangle, TipBox, fits, stroke_margins, tip_box_margins

DEFAULT = RobotGeometry()


def test_the_result_serves_the_box_by_the_exact_test(smallest: Optimum) -> None:
    robot = smallest.geometry
    assert smallest.verdict.passed
    margins = tip_box_margins(robot, TipBox.regular(robot))
    assert margins.plane.smallest.value_mm >= 10
    report = study(robot)
    assert report.regular_square.fits
    assert report.box.fits
    assert report.worst_condition is not None
    assert report.worst_condition.value <= 3
    assert report.largest_force is not None
    assert report.largest_force.margin_n >= 0


def test_the_result_is_much_smaller_than_the_default_under_the_same_demands(
    smallest: Optimum,
) -> None:
    assert smallest.start_verdict.passed
    assert smallest.value < 0.6 * smallest.start_value
    width, height = occupied_size_mm(smallest.geometry)
    assert smallest.value == pytest.approx(width * height)
    width, height = occupied_size_mm(DEFAULT)
    assert (width, height) == pytest.approx((1350, 435 + 80 + 10 * math.tan(math.radians(10))))


def test_the_golden_result(smallest: Optimum) -> None:
    robot = smallest.geometry
    assert (robot.leg_length_mm, robot.base_width_mm) == (323, 904)
    assert (robot.rho1.max_mm, robot.rho2.max_mm) == (423, 423)
    assert robot.regular_box.center_y_mm == 204
    assert smallest.binding == (Demand.CONDITION,)


def test_no_neighbour_is_smaller_and_still_serves(smallest: Optimum) -> None:
    """Shrink each length of the result by a millimetre: each shrunk robot fails the demands."""
    robot = smallest.geometry
    for change in (
        {"leg_length_mm": robot.leg_length_mm - 1},
        {"base_width_mm": robot.base_width_mm - 1},
        {"rho1": robot.rho1.model_copy(update={"max_mm": robot.rho1.max_mm - 1})},
        {"regular_box": robot.regular_box.model_copy(update={"center_y_mm": 203})},
    ):
        assert not verify(robot.model_copy(update=change), Demands()).passed, change


@pytest.mark.parametrize("seed", [1, 2])
def test_every_seed_finds_it(smallest: Optimum, seed: int) -> None:
    assert optimise(DEFAULT, seed=seed).value == pytest.approx(smallest.value, rel=2e-3)


def test_demands_are_kept_when_others_bind() -> None:
    demands = Demands(
        width_mm=150, height_mm=260, margin_mm=25, max_condition=8,
        limits=ActuatorLimits(rho1_n=60, rho2_n=60),
    )  # fmt: skip
    found = optimise(DEFAULT, demands)
    assert Demand.CARRIAGE_FORCE in found.binding
    assert verify(found.geometry, demands).passed
    box = found.geometry.regular_box
    assert (box.width_mm, box.height_mm) == (150, 260)
    margins = stroke_margins(found.geometry, Rectangle.of_box(box))
    strokes = (margins.rho1_min, margins.rho1_max, margins.rho2_min, margins.rho2_max)
    assert min(margin.value_mm for margin in strokes) >= 25


def test_bounds_are_kept() -> None:
    bounds = SearchBounds(
        leg_length_mm=Bounds(low_mm=400, high_mm=420),
        e1x_mm=Bounds(low_mm=5, high_mm=5),
        base_width_max_mm=1100,
    )
    found = optimise(DEFAULT, bounds=bounds, objective=Objective.BASE_WIDTH)
    robot = found.geometry
    assert 400 <= robot.leg_length_mm <= 420
    assert robot.e1x_mm == 5
    assert robot.base_width_mm <= 1100
    assert found.value == robot.base_width_mm
    assert found.verdict.passed


def test_an_asymmetric_robot_is_served_as_well() -> None:
    base = RobotGeometry(e1y_mm=30, e2y_mm=-20, theta_rad=0.2)
    found = optimise(base)
    assert found.verdict.passed
    assert (found.geometry.e1y_mm, found.geometry.e2y_mm) == (30, -20)
    assert fits(found.geometry, Rectangle.of_box(found.geometry.regular_box))


@pytest.mark.parametrize(
    ("demands", "bounds", "named"),
    [
        (Demands(max_condition=1.1), SearchBounds(), Demand.CONDITION),
        (Demands(width_mm=600), SearchBounds(base_width_max_mm=1000), Demand.BASE_WIDTH),
        (Demands(), SearchBounds(stroke_max_mm=210), Demand.STROKE),
        (
            Demands(limits=ActuatorLimits(rho1_n=2, rho2_n=2)),
            SearchBounds(),
            Demand.CARRIAGE_FORCE,
        ),
    ],
)
def test_the_demand_that_stands_in_the_way_is_named(
    demands: Demands, bounds: SearchBounds, named: Demand
) -> None:
    with pytest.raises(NoDesignError, match=named.value) as caught:
        optimise(DEFAULT, demands, bounds)
    assert named in caught.value.missed
    assert named in caught.value.binding


def test_a_slide_that_is_too_short_cannot_be_searched_away() -> None:
    short = RobotGeometry.model_validate({"rho3": {"min_mm": 50, "max_mm": 120}})
    with pytest.raises(NoDesignError, match=r"slide_travel by 14\.7 %") as caught:
        optimise(short)
    assert caught.value.binding == ()
    with pytest.raises(NoDesignError, match="slide_force"):
        optimise(DEFAULT, Demands(limits=ActuatorLimits(rho3_n=60)))


def test_the_progress_runs_to_its_end() -> None:
    steps: list[tuple[int, int]] = []
    optimise(DEFAULT, on_step=lambda done, total: steps.append((done, total)))
    done, totals = zip(*steps, strict=True)
    assert list(done) == sorted(done)
    assert len(set(totals)) == 1
    assert done[-1] == totals[-1]


def test_candidates_promise_what_the_exact_test_finds() -> None:
    """The formulas of the search against the exact workspace, for random designs."""
    demands = Demands()
    designer = Designer(DEFAULT, demands, SearchBounds())
    points = np.random.default_rng(0).random((60, 5))
    found = designer.complete(designer.lengths(points))
    reachable = [
        i
        for i in range(60)
        if found.excess[Demand.LEG_LENGTH][i] < 0 and found.excess[Demand.ABOVE_CARRIAGES][i] < 0
    ]
    assert len(reachable) > 10
    for i in reachable:
        checks = {
            check.demand: check for check in verify(designer.geometry(found, i), demands).checks
        }
        assert demands.margin_mm <= checks[Demand.STROKE].value + 1e-9
        assert checks[Demand.STROKE].value <= demands.margin_mm + 2.0
        condition = found.excess[Demand.CONDITION][i]
        if condition < 100:
            exact = checks[Demand.CONDITION].value / demands.max_condition - 1
            assert condition == pytest.approx(exact, rel=1e-6)
            force = checks[Demand.CARRIAGE_FORCE].value / 100 - 1
            assert found.excess[Demand.CARRIAGE_FORCE][i] == pytest.approx(force, rel=1e-6)


def test_bounds_in_the_wrong_order_are_refused() -> None:
    with pytest.raises(ValueError, match="must not be less than the lower one"):
        Bounds(low_mm=5, high_mm=4)
