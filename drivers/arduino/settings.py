"""The numbers of one motion board and its drives: configuration, not code."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

Positive = Annotated[float, Field(gt=0, le=1e6, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, le=1e6, allow_inf_nan=False)]
Pwm = Annotated[int, Field(ge=0, le=255)]


class Group(BaseModel):
    """Base of all groups: immutable, and a misspelt name is an error."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class AxisSettings(Group):
    """One axis: its scale, its switch and how it homes."""

    units_per_mm: Positive = Field(description="microsteps or encoder counts per mm; calibrated")
    reversed: bool = Field(False, description="positive motion needs the other direction level")
    switch_closes: bool = Field(
        False, description="the limit switch closes when pressed, so that a cut wire goes unseen"
    )
    switch_below_travel_mm: NotNegative = Field(
        0.5, description="the limit switch is this far below the start of the travel"
    )
    stop_deceleration_mm_s2: Positive = 1500.0
    seek_speed_mm_s: Positive = 40.0
    locate_speed_mm_s: Positive = 2.0
    homing_acceleration_mm_s2: Positive = 300.0
    back_off_mm: Positive = 3.0
    beyond_travel_mm: Positive = Field(
        20.0, description="a switch further beyond the travel than this is missing"
    )


class SlideSettings(Group):
    """The closed loop of rho3. PWM runs from 0 to 255.

    The board makes up for friction and back EMF, which leaves the bare inertia of the motor: with a
    time constant of 50 ms, m = 110 x 50 = 5500 PWM per count/ms^2. So the gains follow from the
    wanted eigenfrequency and a damping of 1: kp = m w^2 and kd = 2 m w, here w = 0.02 per ms. The
    loop stays stable while m ki / 1000 < kd kp (Routh); the integral is a quarter of that.
    """

    encoder_reversed: bool = False
    kp_pwm_per_count: Annotated[float, Field(ge=0, le=255)] = 2.2
    ki_pwm_per_count_s: Annotated[float, Field(ge=0, le=999)] = 20.0
    kd_pwm_per_count_ms: Annotated[float, Field(ge=0, le=255)] = 220.0
    integral_pwm_max: Pwm = Field(
        150, description="carries the load of the insertion; less and the slide stops short"
    )
    friction_pwm: Pwm = Field(12, description="overcomes the dry friction of motor and screw")
    back_emf_pwm_per_count_ms: Annotated[float, Field(ge=0, le=255)] = Field(
        110.0, description="share of the PWM that the speed of the motor takes"
    )
    pwm_per_newton: Annotated[float, Field(gt=1 / 256, le=255)] = 1.6
    force_limit_n: Positive = Field(90.0, description="after a start, until it is set")
    force_max_n: Annotated[float, Field(gt=0, le=3000)] = 150.0
    stall_s: Annotated[float, Field(gt=0, le=10)] = 0.1
    following_error_mm: Positive = 3.0
    settled_mm: Positive = Field(0.02, description="nearer to its set point the slide has arrived")
    near_mm: Positive = Field(
        0.1,
        description="where it stands still for half a second: nearer it has arrived, too, further "
        "away that is a following error",
    )

    @model_validator(mode="after")
    def _limit_is_possible(self) -> Self:
        if self.force_limit_n > self.force_max_n:
            msg = (
                f"force_limit_n ({self.force_limit_n:g}) must not exceed "
                f"force_max_n ({self.force_max_n:g})"
            )
            raise ValueError(msg)
        if self.near_mm < self.settled_mm:
            msg = f"near_mm ({self.near_mm:g}) must not be below settled_mm ({self.settled_mm:g})"
            raise ValueError(msg)
        return self


class BoardSettings(Group):
    """The whole board.

    Steppers: 200 steps x 8 microsteps x 5.18 on an 18-tooth MXL pulley of 36.576 mm. The encoder
    of the DC motor is counted twice per period; its counts per mm are to be calibrated.
    """

    rho1: AxisSettings = AxisSettings(units_per_mm=200 * 8 * 5.18 / 36.576)
    rho2: AxisSettings = AxisSettings(units_per_mm=200 * 8 * 5.18 / 36.576)
    rho3: AxisSettings = AxisSettings(
        units_per_mm=93.0,
        stop_deceleration_mm_s2=400.0,
        seek_speed_mm_s=10.0,
        homing_acceleration_mm_s2=100.0,
    )
    slide: SlideSettings = SlideSettings()
    carriage_sum_mm: Positive = Field(
        300.0, description="rho1 + rho2 while a carriage seeks its switch, so that the legs close"
    )
    position_tolerance_mm: Positive = Field(
        5e-3, description="a motion may begin this far from where the board stands"
    )
    velocity_tolerance_mm_s: Positive = Field(0.5, description="jump between two segments")
    limit_tolerance_mm: Positive = 0.01
    speed_tolerance: Annotated[float, Field(ge=0, le=0.2)] = Field(
        0.01, description="excess over the velocity limits accepted"
    )

    @property
    def axes(self) -> tuple[AxisSettings, AxisSettings, AxisSettings]:
        """Settings of rho1, rho2, rho3."""
        return (self.rho1, self.rho2, self.rho3)
