from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given

from tests.twin.strategies import PosedRobot, posed_robots
from twin.geometry import RobotGeometry
from twin.kinematics import LegsCannotCloseError, UnreachableError, UnreachableReason, alpha
from twin.kinematics.alpha import LegVectors, PlatformPosition

DEFAULT = RobotGeometry()


@pytest.mark.parametrize(
    ("x_mm", "y_mm", "rho1_mm", "rho2_mm"),
    [
        # rho1 = x + 25 - 80 - sqrt(532^2 - y^2), rho2 = 1300 - x - 80 + 25 - sqrt(532^2 - y^2)
        (650, 335, 181.7216, 181.7216),  # the reach of both legs is sqrt(170799) = 413.2784
        (550, 235, 17.7171, 217.7171),  # the reach is sqrt(227799) = 477.2829
        (750, 235, 217.7171, 17.7171),
        (550, 435, 188.7338, 388.7338),  # the reach is sqrt(93799) = 306.2662
        (750, 435, 388.7338, 188.7338),
    ],
)
def test_regular_square_of_the_default_robot(
    x_mm: float, y_mm: float, rho1_mm: float, rho2_mm: float
) -> None:
    assert alpha.inverse(DEFAULT, PlatformPosition(x_mm, y_mm)) == pytest.approx(
        (rho1_mm, rho2_mm), abs=1e-4
    )
    assert alpha.forward(DEFAULT, rho1_mm, rho2_mm) == pytest.approx((x_mm, y_mm), abs=1e-3)


def test_the_published_inverse_with_2_l_squared_is_a_misprint() -> None:
    """At its own centre the printed sqrt(2 L^2 - y^2) gives -184 mm; the constraint gives +77."""
    geometry = RobotGeometry(e1x_mm=0, e2x_mm=0)
    rho1_mm, _ = alpha.inverse(geometry, PlatformPosition(570, 335))
    assert rho1_mm == pytest.approx(76.72, abs=0.01)
    printed_mm = 570 - 80 - math.sqrt(2 * 532**2 - 335**2)
    assert printed_mm == pytest.approx(-183.66, abs=0.01)


def test_carriages_at_different_heights_by_hand() -> None:
    """Legs of 500 mm as 3-4-5 triangles: (300, 400) from the left foot, (400, 300) to the right."""
    geometry = RobotGeometry(
        leg_length_mm=500, base_width_mm=1000, e1x_mm=0, e2x_mm=0, e1y_mm=-20, e2y_mm=80
    )
    v = alpha.forward(geometry, 60, 80)
    # feet at x = 60 + 80 and 1000 - 80 - 80, 700 mm apart
    assert v == pytest.approx((440, 380))
    assert alpha.inverse(geometry, PlatformPosition(440, 380)) == pytest.approx((60, 80))


@given(posed_robots())
def test_the_pose_satisfies_the_constraints_in_the_right_modes(robot: PosedRobot) -> None:
    d1, h1, d2, h2 = robot.legs
    length = robot.geometry.leg_length_mm
    assert (math.hypot(d1, h1), math.hypot(d2, h2)) == pytest.approx((length, length))
    assert d1 > 0
    assert d2 > 0
    assert d1 * h2 + d2 * h1 > 0


@given(posed_robots())
def test_jacobian_is_the_slope_of_forward(robot: PosedRobot) -> None:
    rho = robot.joints[:2]
    step = 1e-4
    slopes = [
        np.subtract(
            alpha.forward(robot.geometry, *(np.add(rho, direction))),
            alpha.forward(robot.geometry, *(np.subtract(rho, direction))),
        )
        / (2 * step)
        for direction in (np.array([step, 0]), np.array([0, step]))
    ]
    np.testing.assert_allclose(alpha.jacobian(robot.legs), np.column_stack(slopes), atol=2e-6)


@given(posed_robots())
def test_velocity_matrices_agree_with_the_jacobian(robot: PosedRobot) -> None:
    matrix_a, matrix_b = alpha.velocity_matrices(robot.legs)
    np.testing.assert_allclose(
        matrix_a @ alpha.jacobian(robot.legs), matrix_b, atol=1e-9 * robot.geometry.leg_length_mm
    )


def test_no_jacobian_when_folded_flat() -> None:
    with pytest.raises(LegsCannotCloseError, match="folded flat"):
        alpha.jacobian(LegVectors(532, 0, 532, 0))


def test_above_the_legs() -> None:
    with pytest.raises(UnreachableError, match=r"the legs are 14\.2 mm too short") as caught:
        alpha.inverse(DEFAULT, PlatformPosition(650, 532 + 14.2))
    assert caught.value.reason is UnreachableReason.LEGS_TOO_SHORT
    assert caught.value.excess_mm == pytest.approx(14.2)
    assert caught.value.joint is None


def test_below_the_carriages() -> None:
    with pytest.raises(UnreachableError, match=r"30\.0 mm on the wrong side") as caught:
        alpha.inverse(DEFAULT, PlatformPosition(650, -30))
    assert caught.value.reason is UnreachableReason.WRONG_SIDE


@pytest.mark.parametrize("v", [(math.nan, 300.0), (650.0, math.nan), (math.inf, 300.0)])
def test_not_a_position(v: tuple[float, float]) -> None:
    with pytest.raises(UnreachableError, match="is not a position") as caught:
        alpha.inverse(DEFAULT, PlatformPosition(*v))
    assert caught.value.reason is UnreachableReason.NOT_FINITE


@pytest.mark.parametrize(
    ("rho1_mm", "rho2_mm", "sentence"),
    [
        (0.0, 0.0, r"1190\.0 mm apart; the legs bridge .* at most 1064\.0 mm"),
        (700.0, 700.0, "lean outwards"),
        (595.0, 595.0, "apart"),
        (math.nan, 100.0, "nan mm apart"),
    ],
)
def test_joints_that_belong_to_no_pose(rho1_mm: float, rho2_mm: float, sentence: str) -> None:
    with pytest.raises(LegsCannotCloseError, match=sentence):
        alpha.forward(DEFAULT, rho1_mm, rho2_mm)


def test_many_positions_agree_with_one_and_mark_the_impossible() -> None:
    x, y = np.meshgrid(np.linspace(-300, 1600, 60), np.linspace(-600, 600, 61))
    grid = np.stack((x, y), axis=-1)
    for geometry in (DEFAULT, RobotGeometry(e1y_mm=70, e2y_mm=-40)):
        many = alpha.inverse_many(geometry, grid)
        assert many.shape == grid.shape
        for v, found in zip(grid.reshape(-1, 2), many.reshape(-1, 2), strict=True):
            try:
                one = alpha.inverse(geometry, PlatformPosition(*v))
            except UnreachableError:
                assert np.isnan(found).all()
            else:
                assert found == pytest.approx(one, abs=1e-9)


def test_many_actuators_agree_with_one_and_mark_the_impossible() -> None:
    rho1, rho2 = np.meshgrid(np.linspace(-200, 900, 60), np.linspace(-200, 900, 60))
    grid = np.stack((rho1, rho2), axis=-1)
    for geometry in (DEFAULT, RobotGeometry(e1y_mm=70, e2y_mm=-40)):
        impossible = 0
        for rho, found in zip(
            grid.reshape(-1, 2), alpha.forward_many(geometry, grid).reshape(-1, 2), strict=True
        ):
            try:
                one = alpha.forward(geometry, *rho)
            except LegsCannotCloseError:
                assert np.isnan(found).all()
                impossible += 1
            else:
                assert found == pytest.approx(one, abs=1e-9)
        assert 0 < impossible < 3600
