from __future__ import annotations

import pytest
from hypothesis import given
from pydantic import ValidationError

from tests.twin.strategies import between
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import alpha
from twin.kinematics.alpha import PlatformPosition
from twin.statics import SagTables, sag

DEFAULT = RobotGeometry()


def joints(x_mm: float, y_mm: float, rho3_mm: float = 100.0) -> JointPosition:
    return JointPosition(*alpha.inverse(DEFAULT, PlatformPosition(x_mm, y_mm)), rho3_mm)


@pytest.mark.parametrize(
    ("x_mm", "y_mm", "expected_mm"),
    [
        (550, 235, 0.995),
        (650, 235, 0.993),
        (750, 235, 0.991),
        (550, 335, 0.990),
        (650, 335, 0.996),
        (750, 335, 0.989),
        (550, 435, 1.030),
        (650, 435, 1.010),
        (750, 435, 1.030),
        (600, 335, 0.993),  # half way between 0.990 and 0.996
        (700, 385, (0.996 + 0.989 + 1.010 + 1.030) / 4),
    ],
)
def test_sag_of_alpha(x_mm: float, y_mm: float, expected_mm: float) -> None:
    assert sag(DEFAULT, joints(x_mm, y_mm)).alpha_mm == pytest.approx(expected_mm, abs=1e-9)


@pytest.mark.parametrize(
    ("rho3_mm", "expected_mm"),
    [(50, 1.080), (75, 0.996), (100, 0.936), (125, 0.907), (150, 0.958), (60, 1.0464)],
)
def test_sag_of_beta(rho3_mm: float, expected_mm: float) -> None:
    found = sag(DEFAULT, joints(650, 335, rho3_mm))
    assert found.beta_mm == pytest.approx(expected_mm)
    assert found.bound_mm == pytest.approx(0.996 + expected_mm)
    assert found.within_table


@pytest.mark.parametrize(
    ("pose", "alpha_mm", "beta_mm"),
    [
        ((450, 335, 100), 0.990, 0.936),
        ((800, 335, 100), 0.989, 0.936),
        ((650, 100, 100), 0.993, 0.936),
        ((650, 500, 100), 1.010, 0.936),
        ((650, 335, 20), 0.996, 1.080),
        ((650, 335, 170), 0.996, 0.958),
    ],
)
def test_outside_the_tables_the_nearest_value_stands_in_and_is_marked(
    pose: tuple[float, float, float], alpha_mm: float, beta_mm: float
) -> None:
    found = sag(DEFAULT, joints(*pose))
    assert not found.within_table
    assert (found.alpha_mm, found.beta_mm) == pytest.approx((alpha_mm, beta_mm))


@given(between(450, 850), between(150, 500), between(20, 180))
def test_interpolation_stays_between_the_table_values(x: float, y: float, rho3: float) -> None:
    found = sag(DEFAULT, joints(x, y, rho3))
    assert 0.989 - 1e-12 <= found.alpha_mm <= 1.030 + 1e-12
    assert 0.907 - 1e-12 <= found.beta_mm <= 1.080 + 1e-12


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"beta_mm": (1.0, 2.0)}, "the same length"),
        ({"beta_mm": (1.0,), "beta_rho3_mm": (50.0,)}, "at least 2"),
        ({"beta_rho3_mm": (50.0, 100.0, 75.0, 125.0, 150.0)}, "must ascend"),
    ],
)
def test_tables_that_make_no_sense_are_refused(change: dict[str, object], sentence: str) -> None:
    with pytest.raises(ValidationError, match=sentence):
        SagTables.model_validate(change)
