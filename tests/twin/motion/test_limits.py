from __future__ import annotations

import math

import pytest
from pydantic import ValidationError

from twin.motion import InvalidMotionError, JointLimits, MotionLimits


def test_scaling_keeps_the_time_of_the_ramps() -> None:
    slow = MotionLimits().scaled(0.25)
    assert slow.rho1 == JointLimits(velocity_mm_s=20, acceleration_mm_s2=100, jerk_mm_s3=1000)
    assert slow.rho3.velocity_mm_s / slow.rho3.acceleration_mm_s2 == pytest.approx(14 / 100)


@pytest.mark.parametrize("fraction", [0.0, -0.5, 1.01, math.nan])
def test_only_slower_is_possible(fraction: float) -> None:
    with pytest.raises(InvalidMotionError, match="greater than 0 and at most 1"):
        MotionLimits().scaled(fraction)


@pytest.mark.parametrize("value", [0, -1, math.inf, math.nan])
def test_limits_are_positive_and_finite(value: float) -> None:
    with pytest.raises(ValidationError):
        JointLimits(velocity_mm_s=value, acceleration_mm_s2=1, jerk_mm_s3=1)
