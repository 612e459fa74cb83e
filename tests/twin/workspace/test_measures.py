from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings

from tests.twin.strategies import PosedRobot, between, posed_robots
from tests.twin.workspace.robots import DEFAULT, UNEVEN, robots
from twin.geometry import RobotGeometry
from twin.kinematics import PlatformPosition, alpha, singularity
from twin.statics import LoadCase, Loads, alpha_actuator_forces
from twin.workspace import (
    InvalidGridError,
    Measure,
    PlanarForce,
    Rectangle,
    RectangleOutsideError,
    SingularRectangleError,
    largest_rectangle,
    map_axes,
    measure_rows,
    reachable_region,
    workspace_maps,
    worst_over,
)

FORCE = PlanarForce(7, -30)
REGULAR = Rectangle.of_box(DEFAULT.regular_box)


def one(robot: PosedRobot, measure: Measure) -> float:
    h1 = robot.legs.h1_mm
    return float(measure_rows(robot.geometry, measure, np.array(h1 + robot.geometry.e1y_mm), FORCE))


@given(posed_robots())
def test_they_are_those_of_the_kinematics_and_the_statics(robot: PosedRobot) -> None:
    geometry, legs = robot.geometry, robot.legs
    found = singularity.measures_of_legs(geometry, legs)
    length = geometry.leg_length_mm
    assert one(robot, Measure.DETERMINANT) == pytest.approx(found.parallel * length**2)
    assert one(robot, Measure.D1) == pytest.approx(legs.d1_mm)
    assert one(robot, Measure.D2) == pytest.approx(legs.d2_mm)
    assert one(robot, Measure.PARALLELOGRAM_AREA) == pytest.approx(
        found.parallelogram_area_mm2, abs=1e-6
    )
    force1, force2 = alpha_actuator_forces(legs, FORCE.x_n, FORCE.y_n)
    assert one(robot, Measure.FORCE1) == pytest.approx(force1, abs=1e-8)
    assert one(robot, Measure.FORCE2) == pytest.approx(force2, abs=1e-8)
    jacobian = alpha.jacobian(legs)
    greatest, least = np.linalg.svd(jacobian, compute_uv=False)
    assert one(robot, Measure.SPEED_MAX) == pytest.approx(greatest)
    assert one(robot, Measure.SPEED_MIN) == pytest.approx(least)
    assert one(robot, Measure.CONDITION) == pytest.approx(np.linalg.cond(jacobian))


def test_out_of_reach_and_on_the_singularities() -> None:
    y = np.array([-1.0, 0.0, 300.0, 532.0, 533.0, np.nan])
    condition = measure_rows(DEFAULT, Measure.CONDITION, y)
    assert np.isnan(condition[[0, 4, 5]]).all()
    assert np.isinf(condition[1])
    assert condition[2] > 1
    np.testing.assert_array_equal(measure_rows(DEFAULT, Measure.DETERMINANT, y[[1, 3]]), 0)
    assert np.isinf(measure_rows(DEFAULT, Measure.FORCE1, y[[1]], PlanarForce(0, 1))).all()


def test_a_pure_lift_asks_less_the_higher_the_platform_stands() -> None:
    """Each carriage carries fy d / (2 h) in the symmetric robot."""
    y = np.linspace(100, 500, 41)
    force = measure_rows(DEFAULT, Measure.FORCE1, y, PlanarForce(0, 40))
    np.testing.assert_allclose(force, 40 * np.sqrt(532**2 - y**2) / (2 * y))
    assert (np.diff(force) < 0).all()


def test_forces_of_inserting_and_withdrawing() -> None:
    """Pushing down the slope leaves a part of the weight to the socket; pulling adds to it."""
    loads = Loads()
    weight = 9.80665 * loads.on_platform_kg
    for case, axial in (
        (LoadCase.HOLDING, 0),
        (LoadCase.INSERTING, 70),
        (LoadCase.WITHDRAWING, -70),
    ):
        force = PlanarForce.of_loads(DEFAULT, loads, case)
        assert force.x_n == 0
        assert force.y_n == pytest.approx(weight + axial * math.sin(math.radians(-10)))


@settings(max_examples=40)
@given(robots(), between(0.1, 0.9), between(0.3, 3))
def test_no_sample_of_a_rectangle_is_worse(
    geometry: RobotGeometry, share: float, aspect: float
) -> None:
    best = largest_rectangle(geometry, aspect).rectangle
    rectangle = Rectangle(
        best.center_x_mm, best.center_y_mm, share * best.width_mm, share * best.height_mm
    )
    y = np.linspace(rectangle.y_min_mm, rectangle.y_max_mm, 777)
    for measure in Measure:
        found = worst_over(geometry, rectangle, measure, FORCE)
        sampled = measure_rows(geometry, measure, y, FORCE)
        slack = 1e-9 * max(1, float(np.abs(sampled).max()))
        assert found.least.value <= sampled.min() + slack
        assert found.greatest.value >= sampled.max() - slack
        for extreme in (found.least, found.greatest):
            again = measure_rows(geometry, measure, np.array(extreme.at.y_mm), FORCE)
            assert float(again) == pytest.approx(extreme.value, abs=slack)
            assert rectangle.y_min_mm <= extreme.at.y_mm <= rectangle.y_max_mm
        assert np.abs(sampled - found.least.value).min() < 1e-2 * np.ptp(sampled) + slack


def test_the_regular_square() -> None:
    determinant = worst_over(DEFAULT, REGULAR, Measure.DETERMINANT)
    assert determinant.least.at.y_mm == 235
    # both legs at 45 deg
    assert determinant.greatest.value == pytest.approx(532**2)
    assert determinant.greatest.at.y_mm == pytest.approx(532 * math.sin(math.pi / 4), abs=1e-3)
    condition = worst_over(DEFAULT, REGULAR, Measure.CONDITION)
    assert condition.least.value == pytest.approx(1)
    assert condition.greatest.at.y_mm == 235
    assert worst_over(DEFAULT, REGULAR, Measure.D1).least.at.y_mm == 435


def test_an_extreme_inside_a_flat_parallelogram() -> None:
    """With F above V the parallelogram is flat where AB is parallel to BF, inside the square."""
    geometry = DEFAULT.model_copy(update={"e_py_mm": 50.0})
    area = worst_over(geometry, REGULAR, Measure.PARALLELOGRAM_AREA)
    assert area.least.value == pytest.approx(0, abs=1e-6)
    assert area.least.at.y_mm == pytest.approx(532 * math.sin(math.atan(50 / 80)))


def test_rectangles_that_touch_a_singularity() -> None:
    low = Rectangle(650, 10, 20, 20)
    with pytest.raises(SingularRectangleError, match=r"at y = 0\.0 mm the legs are in line") as at:
        worst_over(DEFAULT, low, Measure.FORCE1, FORCE)
    assert at.value.code == "singular_rectangle"
    assert worst_over(DEFAULT, low, Measure.DETERMINANT).least.value == 0
    assert worst_over(DEFAULT, low, Measure.D1).greatest.value == 532
    # the left carriage is the lower one here: its leg stands upright first
    geometry = UNEVEN.model_copy(update={"e1y_mm": -100.0, "rho1": DEFAULT.rho1})
    upright = reachable_region(geometry)
    assert upright.extent.y_max_mm < 432
    long = geometry.model_copy(
        update={
            "rho1": geometry.rho1.model_copy(update={"max_mm": 900.0}),
            "rho2": geometry.rho2.model_copy(update={"max_mm": 900.0}),
        }
    )
    high = Rectangle(650, 422, 20, 20)
    with pytest.raises(SingularRectangleError, match="the left leg stands upright"):
        worst_over(long, high, Measure.CONDITION)
    assert worst_over(long, high, Measure.SPEED_MIN).least.value == pytest.approx(0, abs=1e-6)


def test_a_rectangle_outside() -> None:
    with pytest.raises(RectangleOutsideError):
        worst_over(DEFAULT, Rectangle.square(650, 500, 200), Measure.D1)


def test_maps() -> None:
    x, y = map_axes(DEFAULT, 20)
    assert x[[0, -1]] == pytest.approx((440, 860))
    assert y[[0, -1]] == pytest.approx((0, reachable_region(DEFAULT).extent.y_max_mm))
    assert max(np.diff(x).max(), np.diff(y).max()) <= 20
    maps = workspace_maps(DEFAULT, x, y, FORCE)
    assert maps.inside.shape == (len(y), len(x))
    area = maps.inside.mean() * np.ptp(x) * np.ptp(y)
    assert area == pytest.approx(reachable_region(DEFAULT).area_mm2, rel=0.1)
    for row, column in np.argwhere(maps.inside)[::7]:
        v = PlatformPosition(float(x[column]), float(y[row]))
        rho1, rho2 = alpha.inverse(DEFAULT, v)
        assert maps.rho1_mm[row, column] == pytest.approx(rho1)
        assert maps.rho2_mm[row, column] == pytest.approx(rho2)
        assert maps.stroke_left_mm[row, column] == pytest.approx(
            min(rho1, rho2, 420 - rho1, 420 - rho2), abs=1e-6
        )
    outside = ~maps.inside
    for grid in (maps.rho1_mm, maps.rho2_mm, maps.stroke_left_mm, maps.of(Measure.D1)):
        assert np.isnan(grid[outside]).all()
        assert not np.isnan(grid[maps.inside]).any()
    forces = maps.of(Measure.FORCE2)
    row, column = np.argwhere(maps.inside)[100]
    legs = alpha.leg_vectors(
        DEFAULT,
        PlatformPosition(float(x[column]), float(y[row])),
        float(maps.rho1_mm[row, column]),
        float(maps.rho2_mm[row, column]),
    )
    assert forces[row, column] == pytest.approx(alpha_actuator_forces(legs, 7, -30)[1])


@pytest.mark.parametrize("step", [0.0, -1.0, math.nan, math.inf])
def test_steps_that_make_no_grid(step: float) -> None:
    with pytest.raises(InvalidGridError, match="cannot have a step"):
        map_axes(DEFAULT, step)
