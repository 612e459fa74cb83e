"""The mechanism as built: both ways, against the drawn robot, and its derivatives."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from twin.as_built import PARAMETERS, JointCorrection, PlanarAsBuilt
from twin.as_built.planar import Array
from twin.geometry import RobotGeometry
from twin.kinematics import LegsCannotCloseError, alpha

DRAWN = RobotGeometry()
RHO = np.array([[120.0, 110.0], [20.0, 380.0], [380.0, 30.0], [200.0, 200.0], [330.0, 120.0]])
OFF_BY = np.array([3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 0.009, 0.009, 0.005, 0.005])
"""How badly robots are built, in the order of PARAMETERS."""


@st.composite
def built_robots(draw: st.DrawFn) -> PlanarAsBuilt:
    shares = draw(st.lists(st.floats(-1, 1), min_size=10, max_size=10))
    return PlanarAsBuilt.from_vector(
        PlanarAsBuilt.as_drawn(DRAWN).vector + OFF_BY * np.array(shares)
    )


def test_as_drawn_moves_as_the_drawing() -> None:
    built = PlanarAsBuilt.as_drawn(DRAWN)
    np.testing.assert_allclose(
        built.forward_many(RHO), alpha.forward_many(DRAWN, RHO), rtol=0, atol=1e-9
    )


@given(built_robots())
def test_the_inverse_undoes_the_forward(built: PlanarAsBuilt) -> None:
    np.testing.assert_allclose(built.inverse_many(built.forward_many(RHO)), RHO, rtol=0, atol=1e-8)


@given(built_robots())
def test_both_legs_keep_their_length_and_the_feet_stay_on_their_rails(
    built: PlanarAsBuilt,
) -> None:
    v = built.forward_many(RHO)
    left = np.column_stack(
        (
            built.left_foot_x_mm + built.left_scale * RHO[:, 0] * math.cos(built.left_rail_rad),
            built.left_foot_y_mm + built.left_scale * RHO[:, 0] * math.sin(built.left_rail_rad),
        )
    )
    right = np.column_stack(
        (
            built.right_foot_x_mm - built.right_scale * RHO[:, 1] * math.cos(built.right_rail_rad),
            built.right_foot_y_mm - built.right_scale * RHO[:, 1] * math.sin(built.right_rail_rad),
        )
    )
    np.testing.assert_allclose(np.linalg.norm(v - left, axis=1), built.left_leg_mm, atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(v - right, axis=1), built.right_leg_mm, atol=1e-9)
    assert (v[:, 1] > 0).all()


@given(built_robots())
def test_derivatives_are_the_slopes(built: PlanarAsBuilt) -> None:
    found = built.derivatives_many(RHO, built.forward_many(RHO))
    for number, name in enumerate(PARAMETERS):
        step = 1e-6 if name.endswith(("rad", "scale")) else 1e-3
        ahead, behind = (_moved(built, number, sign * step) for sign in (1.0, -1.0))
        slope = (ahead.forward_many(RHO) - behind.forward_many(RHO)) / (2 * step)
        np.testing.assert_allclose(found[..., number], slope, rtol=1e-5, atol=1e-4, err_msg=name)


@given(built_robots())
def test_one_pose_is_as_many(built: PlanarAsBuilt) -> None:
    for rho, v in zip(RHO, built.forward_many(RHO), strict=True):
        np.testing.assert_allclose(built.forward(*rho), v, rtol=0, atol=1e-9)


@given(built_robots())
def test_the_jacobian_is_the_slope(built: PlanarAsBuilt) -> None:
    for rho in RHO:
        slopes = [
            (built.forward_many(rho + step) - built.forward_many(rho - step)) / 2e-3
            for step in 1e-3 * np.eye(2)
        ]
        np.testing.assert_allclose(built.jacobians_many(rho), np.column_stack(slopes), atol=1e-6)


def test_what_cannot_close_is_not_a_number() -> None:
    built = PlanarAsBuilt.as_drawn(DRAWN)
    with pytest.raises(LegsCannotCloseError, match="too short"):
        built.forward(-200.0, -200.0)
    assert np.isnan(built.forward_many(np.array([[-200.0, -200.0]]))).any()
    assert np.isnan(built.inverse_many(np.array([[650.0, 600.0]]))).any()


def test_absurd_numbers_are_refused() -> None:
    with pytest.raises(ValidationError, match="left_rail_rad"):
        PlanarAsBuilt.from_vector(_with(PlanarAsBuilt.as_drawn(DRAWN).vector, 6, 0.5))


@given(built_robots())
def test_the_correction_puts_the_built_platform_where_the_drawing_has_it(
    built: PlanarAsBuilt,
) -> None:
    correction = JointCorrection(DRAWN, built)
    wanted = np.column_stack((RHO, np.linspace(50, 150, len(RHO))))
    board = correction.to_board_many(wanted)
    np.testing.assert_allclose(
        built.forward_many(board[:, :2]), alpha.forward_many(DRAWN, RHO), rtol=0, atol=1e-8
    )
    np.testing.assert_allclose(correction.from_board_many(board), wanted, rtol=0, atol=1e-8)
    np.testing.assert_array_equal(board[:, 2], wanted[:, 2])


def _with(vector: Array, number: int, value: float) -> Array:
    changed = vector.copy()
    changed[number] = value
    return changed


def _moved(built: PlanarAsBuilt, number: int, by: float) -> PlanarAsBuilt:
    return PlanarAsBuilt.from_vector(_with(built.vector, number, built.vector[number] + by))
