from __future__ import annotations

import math

import pytest
from hypothesis import given

from tests.twin.strategies import between, geometries
from twin.geometry import RobotGeometry
from twin.kinematics import beta

SLOPED = RobotGeometry(theta_rad=math.atan2(-3, 4), e3y_mm=7, e3z_mm=100)
"""Insertion axis (0, -0.6, 0.8)."""


def test_forward_by_hand() -> None:
    assert beta.forward(SLOPED, 50) == pytest.approx((7 - 30, 100 + 40))


def test_inverse_of_a_point_on_the_line() -> None:
    assert beta.inverse(SLOPED, -23, 140) == pytest.approx((50, 0), abs=1e-12)


def test_inverse_keeps_the_sign_behind_the_start() -> None:
    """The published square root would give +50 here."""
    assert beta.inverse(SLOPED, 7 + 30, 100 - 40) == pytest.approx((-50, 0), abs=1e-12)


def test_inverse_reports_how_far_a_point_is_off_the_line() -> None:
    # 5 mm along the normal (0.8, 0.6) of the axis, on the side of +y'
    assert beta.inverse(SLOPED, -23 + 4, 140 + 3) == pytest.approx((50, 5), abs=1e-12)


@given(geometries(), between(-300, 300))
def test_round_trip(geometry: RobotGeometry, rho3_mm: float) -> None:
    point = beta.forward(geometry, rho3_mm)
    assert beta.inverse(geometry, *point) == pytest.approx((rho3_mm, 0), abs=1e-9)
