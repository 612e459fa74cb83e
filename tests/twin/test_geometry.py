from __future__ import annotations

import math

import pytest
from pydantic import ValidationError

from twin.geometry import JointRange, RobotGeometry


def test_insertion_axis_is_a_unit_vector_that_points_down_for_a_negative_angle() -> None:
    x, y, z = RobotGeometry(theta_rad=math.radians(-30)).insertion_axis
    assert (x, y, z) == pytest.approx((0.0, -0.5, math.sqrt(0.75)))


def test_excess_is_signed_and_zero_inside() -> None:
    travel = JointRange(min_mm=10, max_mm=20)
    assert [travel.excess_mm(q) for q in (7.0, 10.0, 15.0, 20.0, 24.0)] == [-3, 0, 0, 0, 4]
    assert travel.stroke_mm == 10


def test_not_a_number_is_never_inside_a_range() -> None:
    assert math.isnan(JointRange(min_mm=10, max_mm=20).excess_mm(math.nan))


def test_a_range_must_ascend() -> None:
    with pytest.raises(ValidationError, match=r"max_mm \(5\) must be greater than min_mm \(5\)"):
        JointRange(min_mm=5, max_mm=5)


def test_legs_that_never_meet_are_refused_with_the_distance_of_their_feet() -> None:
    # 1300 + 50 - 160 - 2 x 420 = 350 mm between the feet, and 2 x 170 = 340 mm of legs
    with pytest.raises(ValidationError, match="less than 340 mm, but their feet stay at least 350"):
        RobotGeometry(leg_length_mm=170)


def test_carriages_too_far_apart_in_height_are_refused() -> None:
    with pytest.raises(ValidationError, match="their feet stay at least 1100 mm apart"):
        RobotGeometry(
            e1y_mm=1100,
            rho1=JointRange(min_mm=0, max_mm=800),
            rho2=JointRange(min_mm=0, max_mm=800),
        )


def test_carriages_that_cross_from_the_start_are_refused() -> None:
    with pytest.raises(ValidationError, match="the carriages cross"):
        RobotGeometry(platform_width_mm=1400)


@pytest.mark.parametrize(
    "change",
    [
        {"leg_length_mm": 0},
        {"leg_length_mm": math.inf},
        {"e1x_mm": math.nan},
        {"theta_rad": math.nan},
        {"theta_rad": math.pi / 2},
        {"leg_lenght_mm": 500},
    ],
)
def test_numbers_that_describe_no_robot_are_refused(change: dict[str, float]) -> None:
    with pytest.raises(ValidationError):
        RobotGeometry.model_validate(change)
