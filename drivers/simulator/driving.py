"""Numbers that describe how a car is driven to its place and what its springs do about it.

The defaults are this project's own estimates of a small car with its socket in the nose, driven
by a careful person in a narrow garage.
"""

from __future__ import annotations

import math
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Positive = Annotated[float, Field(gt=0, le=1e6, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, le=1e6, allow_inf_nan=False)]


class DrivingParameters(BaseModel):
    """A car that drives nose first to the wall, and its driver."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    cruise_mm_s: Positive = Field(500.0, description="speed until near the place")
    creep_mm_s: Positive = Field(140.0, description="speed over the last stretch")
    creep_from_mm: Positive = Field(800.0, description="length of that stretch")
    acceleration_mm_s2: Positive = 700.0
    jerk_mm_s3: Positive = 1800.0
    brake_mm_s2: Positive = Field(1200.0, description="when told to stop")
    brake_jerk_mm_s3: Positive = 6000.0

    wheelbase_mm: Positive = 2590.0
    nose_mm: Positive = Field(3400.0, description="from the rear axle to the socket")
    least_radius_mm: Positive = Field(5000.0, description="of the rear axle, steering locked")
    steering_s: Positive = Field(0.8, description="from straight on to the lock")
    look_ahead_mm: Positive = Field(1800.0, description="how far ahead the driver aims")
    wander_rad: NotNegative = Field(
        math.radians(0.5), description="how far off the driver aims, at most"
    )
    wander_mm: Positive = Field(1300.0, description="way over which that changes once to and fro")

    pitch_rad_per_mm_s2: NotNegative = Field(
        math.radians(2.0) / 9810.0, description="nose down when braking; 2 degrees at 1 g"
    )
    pitch_hz: Positive = Field(1.4, description="natural frequency of the springs")
    pitch_damping: Annotated[float, Field(gt=0, lt=1)] = 0.3
    pitch_centre_below_mm: NotNegative = Field(
        250.0, description="the body turns about a point halfway between the axles, so far below"
    )
