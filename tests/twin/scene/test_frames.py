"""Rotations as the scene wants them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from viser.transforms import SO3

from twin.scene.frames import Quaternion, metres, quaternion, turn


def matrix_of(wxyz: Quaternion) -> NDArray[np.float64]:
    return SO3(np.array(wxyz, dtype=np.float64)).as_matrix().astype(np.float64)


angles = st.floats(-math.pi, math.pi)


@given(angles, angles, angles)
def test_a_quaternion_turns_as_its_matrix(roll: float, pitch: float, yaw: float) -> None:
    matrix = SO3.from_rpy_radians(roll, pitch, yaw).as_matrix().astype(np.float64)
    assert matrix_of(quaternion(matrix)) == pytest.approx(matrix, abs=1e-9)


@pytest.mark.parametrize("axis", [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)])
def test_half_turns_are_no_exception(axis: tuple[float, float, float]) -> None:
    matrix = SO3.exp(math.pi * np.array(axis)).as_matrix().astype(np.float64)
    assert matrix_of(quaternion(matrix)) == pytest.approx(matrix, abs=1e-9)


@given(angles)
def test_a_turn_about_an_axis(angle: float) -> None:
    expected = SO3.from_z_radians(angle).as_matrix().astype(np.float64)
    assert matrix_of(turn((0, 0, 1), angle)) == pytest.approx(expected, abs=1e-9)


def test_millimetres_become_metres() -> None:
    assert metres((1300, -20, 5)) == pytest.approx((1.3, -0.02, 0.005))
