"""Every number of the simulated garage: errors of the build, motors, board, socket, car, camera.

The defaults are this project's own estimates of the real machine unless a source is named.
"""

from __future__ import annotations

import math
from typing import Annotated, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from drivers.simulator.camera.conditions import FLAWLESS, Conditions
from drivers.simulator.camera.imaging import ImagingParameters
from twin.joints import JointPosition

Spread = Annotated[float, Field(ge=0, le=100, allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0, le=1e6, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, le=1e6, allow_inf_nan=False)]
Signed = Annotated[float, Field(ge=-1e4, le=1e4, allow_inf_nan=False)]
Fraction = Annotated[float, Field(ge=0, le=1)]


class Parameters(BaseModel):
    """Base of all groups: immutable, and a misspelt name is an error."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class BuildErrors(Parameters):
    """Standard deviations of how the built machine differs from what is known of it.

    The defaults are what a calibration leaves over, not what a drill and a printer leave.
    """

    length_std_mm: Spread = Field(0.1, description="each of L, L2, L3, e1, e2, e3")
    theta_std_rad: Spread = math.radians(0.05)
    mount_offset_std_mm: Spread = Field(0.05, description="camera on the platform, each axis")
    mount_angle_std_rad: Spread = math.radians(0.008)
    principal_point_std_px: Spread = 0.2
    focal_std_fraction: Spread = 2e-4
    rail_skew_std_rad: Spread = Field(0.0, description="each rail against the x axis")
    belt_scale_std: Spread = Field(0.0, description="each belt's travel over the commanded one")
    sag_scale: NotNegative = Field(1.0, description="of the measured deflection under self-weight")

    @classmethod
    def before_calibration(cls) -> Self:
        """What a drill, a printer and a cheap lens leave.

        Two standard deviations are 3 mm, half a degree of skew, 0.5 % of belt, 5 mm and 3 degrees
        of camera, and 1 % of focal length.
        """
        return cls(
            length_std_mm=1.5,
            theta_std_rad=math.radians(0.25),
            mount_offset_std_mm=2.5,
            mount_angle_std_rad=math.radians(1.5),
            principal_point_std_px=4.0,
            focal_std_fraction=5e-3,
            rail_skew_std_rad=math.radians(0.25),
            belt_scale_std=2.5e-3,
        )


class DriveParameters(Parameters):
    """The three actuators.

    rho1 and rho2: 200 steps x 8 microsteps x 5.18 on an 18-tooth MXL pulley of 36.576 mm.
    """

    microsteps_per_mm: Positive = 200 * 8 * 5.18 / 36.576
    encoder_counts_per_mm: Positive = 93.0
    backlash_mm: tuple[Spread, Spread, Spread] = (0.05, 0.05, 0.05)
    lag_s: Positive = Field(0.02, description="time constant of the rho3 position controller")
    friction_n: NotNegative = Field(1.5, description="of the rho3 screw, seen by the current")
    force_noise_n: NotNegative = Field(0.8, description="standard deviation of a force sample")
    force_scale_std: Spread = Field(0.01, description="error of the motor's torque constant")
    max_force_n: Positive = Field(150.0, description="what the rho3 motor can do at all")


class HomingParameters(Parameters):
    """The homing routine: rho3 first, then the rail; see ``homing.py``."""

    switch_margin_mm: Positive = Field(0.5, description="switches close this far below the stroke")
    rail_speed_mm_s: Positive = 60.0
    slide_speed_mm_s: Positive = 10.0
    locate_speed_mm_s: Positive = 2.0
    acceleration_mm_s2: Positive = 300.0
    back_off_mm: Positive = 3.0
    repeatability_std_mm: Spread = 0.01
    carriage_sum_mm: Positive = Field(
        300.0,
        description="rho1 + rho2 while a carriage seeks its switch: with both at the start of "
        "their strokes the legs could not close",
    )
    power_off_creep_std_mm: Spread = Field(
        0.5, description="how far the joints stand from the stored positions after a power-up"
    )


class BoardParameters(Parameters):
    """The motion board and the link to it."""

    queue_capacity: Annotated[int, Field(ge=2, le=1000)] = 16
    segment_s: Positive = 0.02
    position_tolerance_mm: Positive = 1e-3
    velocity_tolerance_mm_s: Positive = 0.5
    limit_tolerance_mm: Positive = 0.01
    speed_tolerance: Fraction = Field(0.01, description="excess over the velocity limits accepted")
    stop_deceleration_mm_s2: tuple[Positive, Positive, Positive] = (1500.0, 1500.0, 400.0)
    moving_period_s: Positive = 0.01
    rest_period_s: Positive = 0.1
    telemetry_delay_s: Positive = 0.008
    telemetry_jitter_s: NotNegative = Field(0.002, description="uniform, plus or minus")
    command_delay_s: NotNegative = Field(0.0015, description="one way")
    boot_s: Positive = 0.5
    heartbeat_timeout_s: Positive = 0.2
    link_timeout_s: Positive = 0.3
    reconnect_s: Positive = 0.5
    stall_s: Positive = 0.1
    following_error_mm: Positive = 3.0
    settled_mm: Positive = Field(0.02, description="rho3 this near its set point has arrived")
    default_force_limit_n: Positive = 90.0
    start_homed: bool = False
    start_joints: JointPosition | None = Field(
        default=None, description="where the robot stands at power-up; None: where homing ends"
    )

    @model_validator(mode="after")
    def _delay_covers_jitter(self) -> Self:
        if self.telemetry_jitter_s > self.telemetry_delay_s:
            msg = "telemetry_jitter_s must not exceed telemetry_delay_s: samples cannot come early"
            raise ValueError(msg)
        return self


class ContactParameters(Parameters):
    """Forces between plug and socket along the insertion axis; depth 0 is the socket's face."""

    compliance_mm: Positive = Field(1.5, description="lateral error that the chamfer takes up")
    peak_force_n: Positive = 70.0
    peak_force_std_n: Spread = 1.5
    engagement: tuple[tuple[float, float], ...] = Field(
        (
            (0.0, 0.0),
            (2.0, 0.09),
            (4.0, 0.04),
            (18.0, 0.08),
            (30.0, 0.5),
            (36.0, 1.0),
            (38.0, 1.0),
            (40.0, 0.6),
        ),
        description="(depth in mm, share of the peak force) while the plug goes in",
    )
    withdrawal: tuple[tuple[float, float], ...] = Field(
        ((0.0, 0.0), (4.0, 0.04), (18.0, 0.08), (30.0, 0.3), (36.0, 0.7), (38.0, 0.95)),
        description="the same while it comes out",
    )
    seated_depth_mm: Positive = Field(39.5, description="fully plugged in from here; nominally 40")
    stop_depth_mm: Positive = 40.5
    stop_stiffness_n_mm: Positive = 400.0
    friction_stiffness_n_mm: Positive = Field(200.0, description="of the contacts before they slip")
    misalignment_friction_n_mm: NotNegative = Field(3.0, description="per mm off the socket's axis")
    jam_stiffness_n_mm: Positive = 150.0
    lock_stiffness_n_mm: Positive = 150.0
    pilot_makes_mm: Positive = Field(38.5, description="the pilot contact closes at this depth")
    pilot_breaks_mm: Positive = Field(38.0, description="and opens again at this one")
    near_mm: Positive = Field(3.0, description="plug this near the face: integrate the contact")
    step_s: Positive = Field(0.001, description="step of that integration")


class CarParameters(Parameters):
    """How cars park, and what they are like. Lateral places come from the robot's regular box."""

    vehicle_id: Annotated[str, Field(pattern=r"^[a-z0-9-]{1,40}$")] = "demo"
    face_z_mm: tuple[Positive, Positive] = (230.0, 250.0)
    tilt_std_rad: Spread = math.radians(0.8)
    tilt_max_rad: Spread = math.radians(2.0)
    label_size_mm: Positive = 60.0
    socket_offset_mm: tuple[Signed, Signed, Signed] = Field(
        (120.0, 0.0, 0.0), description="socket's face in the label frame, as recommended"
    )
    sticking_std_mm: Spread = Field(0.5, description="label stuck beside its recommended place")
    sticking_angle_std_rad: Spread = math.radians(0.3)
    knowledge_std_mm: Spread = Field(0.05, description="error of the measured label-socket offset")
    battery_wh: Positive = 52_000.0
    state_of_charge: tuple[Fraction, Fraction] = Field((0.3, 0.6), description="on arrival")
    target_state_of_charge: Fraction = 0.8

    @model_validator(mode="after")
    def _ranges_are_ordered(self) -> Self:
        if self.face_z_mm[0] > self.face_z_mm[1]:
            raise ValueError("face_z_mm must be given as (nearest, furthest)")
        if self.state_of_charge[0] > self.state_of_charge[1]:
            raise ValueError("state_of_charge must be given as (lowest, highest)")
        return self


class StationParameters(Parameters):
    """The charging station."""

    name: str = "Simulated station"
    phases: Annotated[int, Field(ge=1, le=3)] = 1
    current_a: Positive = 32.0
    voltage_v: Positive = 230.0
    contactor_closes_s: tuple[Positive, Positive] = Field((0.5, 1.0), description="after enabling")
    ramp_s: Positive = Field(2.0, description="from 0 to full power")
    stop_reaction_s: Positive = Field(1.0, description="from the command to the open contactor")
    answer_s: NotNegative = Field(0.03, description="one way")
    timeout_s: Positive = Field(3.0, description="a hanging station is given up after this")
    current_noise_std: Spread = Field(0.002, description="relative")
    holds: bool = Field(default=True, description="it can keep the power off against others")
    car_locks: bool = Field(default=True, description="the car latches the plug while it charges")


class SimulationParameters(Parameters):
    """All of them."""

    build: BuildErrors = BuildErrors()
    drives: DriveParameters = DriveParameters()
    homing: HomingParameters = HomingParameters()
    board: BoardParameters = BoardParameters()
    contact: ContactParameters = ContactParameters()
    car: CarParameters = CarParameters()
    station: StationParameters = StationParameters()
    imaging: ImagingParameters = ImagingParameters()
    conditions: Conditions = Conditions()

    @classmethod
    def perfect(cls) -> Self:
        """A machine built as drawn, without play, noise or sag; a straight car, a flawless label.

        Steps, encoder counts, lags and delays stay as they are; the car's place is still drawn
        from the seed.
        """
        return cls(
            build=BuildErrors(
                length_std_mm=0,
                theta_std_rad=0,
                mount_offset_std_mm=0,
                mount_angle_std_rad=0,
                principal_point_std_px=0,
                focal_std_fraction=0,
                sag_scale=0,
            ),
            drives=DriveParameters(
                backlash_mm=(0, 0, 0), friction_n=0, force_noise_n=0, force_scale_std=0
            ),
            homing=HomingParameters(repeatability_std_mm=0, power_off_creep_std_mm=0),
            board=BoardParameters(telemetry_jitter_s=0),
            contact=ContactParameters(peak_force_std_n=0),
            car=CarParameters(
                tilt_std_rad=0, sticking_std_mm=0, sticking_angle_std_rad=0, knowledge_std_mm=0
            ),
            station=StationParameters(current_noise_std=0),
            conditions=FLAWLESS,
        )
