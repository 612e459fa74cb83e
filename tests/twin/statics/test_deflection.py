from __future__ import annotations

import pytest
from hypothesis import given
from pydantic import ValidationError

from tests.twin.strategies import between
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import alpha
from twin.kinematics.alpha import PlatformPosition
from twin.statics import SagTables, SagValidity, sag

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
    assert found.validity is SagValidity.INTERPOLATED


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
    assert found.validity is SagValidity.OUTSIDE_TABLE
    assert (found.alpha_mm, found.beta_mm) == pytest.approx((alpha_mm, beta_mm))


def test_the_edge_of_the_table_belongs_to_it() -> None:
    for v, sag_mm in SagTables().nine_points:
        found = sag(DEFAULT, joints(v.x_mm, v.y_mm, 150.0))
        assert found.validity is SagValidity.INTERPOLATED
        assert found.alpha_mm == pytest.approx(sag_mm, abs=1e-6)


def test_the_nine_points_run_row_by_row_from_the_corner_nearest_the_origin() -> None:
    points = SagTables().nine_points
    assert [tuple(v) for v, _ in points[:4]] == [(550, 235), (650, 235), (750, 235), (550, 335)]
    assert [sag_mm for _, sag_mm in points] == [
        0.995, 0.993, 0.991, 0.990, 0.996, 0.989, 1.030, 1.010, 1.030,
    ]  # fmt: skip


def test_the_points_stay_where_they_were_computed_when_the_box_moves() -> None:
    moved = RobotGeometry.model_validate({"regular_box": {"center_x_mm": 700}})
    assert sag(moved, joints(550, 235)).alpha_mm == pytest.approx(0.995)


@pytest.mark.parametrize(
    ("change", "validity"),
    [
        ({"leg_length_mm": 532.4}, SagValidity.INTERPOLATED),
        ({"leg_length_mm": 600}, SagValidity.ANOTHER_ROBOT),
        ({"base_width_mm": 1270}, SagValidity.ANOTHER_ROBOT),
        ({"platform_width_mm": 120}, SagValidity.ANOTHER_ROBOT),
    ],
)
def test_tables_of_another_robot_are_named_as_such(
    change: dict[str, float], validity: SagValidity
) -> None:
    robot = RobotGeometry.model_validate(change)
    pose = JointPosition(*alpha.inverse(robot, PlatformPosition(650, 335)), 100)
    assert sag(robot, pose).validity is validity


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
        ({"beta_rho3_mm": (50.0, 100.0, 75.0, 125.0, 150.0)}, "beta_rho3_mm must ascend"),
        ({"alpha_x_mm": (550.0, 550.0, 750.0)}, "alpha_x_mm must ascend"),
    ],
)
def test_tables_that_make_no_sense_are_refused(change: dict[str, object], sentence: str) -> None:
    with pytest.raises(ValidationError, match=sentence):
        SagTables.model_validate(change)
