"""The board's configuration messages, worked out from geometry, limits and settings."""

from __future__ import annotations

import math

from drivers.arduino.link.crc16 import crc16
from drivers.arduino.protocol import messages
from drivers.arduino.protocol.message import Message
from drivers.arduino.protocol.messages import AxisFlag
from drivers.arduino.scale import AxisScale
from drivers.arduino.settings import AxisSettings, BoardSettings
from twin.geometry import JointRange, RobotGeometry
from twin.motion import JointLimits, MotionLimits

ROUNDING = 0.01
"""Room beyond the host's own limits, relative, so that rounding never makes the board refuse."""


def configuration_messages(
    settings: BoardSettings, geometry: RobotGeometry, limits: MotionLimits
) -> tuple[Message, ...]:
    """Everything but the commit, in the order in which the CRC takes it.

    Args:
        settings: Of the board.
        geometry: Gives the travel.
        limits: Give the largest speeds.
    """
    scales = [AxisScale(axis.units_per_mm) for axis in settings.axes]
    axes = [
        _axis(number, settings, travel, limit)
        for number, (travel, limit) in enumerate(
            zip(geometry.joint_ranges, limits.joints, strict=True)
        )
    ]
    # homing ends with the platform over the middle of the rail and the slide drawn back
    half_mm = 0.5 * settings.carriage_sum_mm
    rest_mm = (half_mm, half_mm, geometry.rho3.min_mm)
    one, two, three = (scale.units(mm) for scale, mm in zip(scales, rest_mm, strict=True))
    homing = messages.ConfigHoming(
        carriage_sum=scales[0].units(settings.carriage_sum_mm), rest_position=(one, two, three)
    )
    return (*axes, _slide(settings), homing)


def configuration_crc(configuration: tuple[Message, ...]) -> int:
    """The CRC that stands for a configuration."""
    return crc16(b"".join(message.pack() for message in configuration))


def _axis(
    number: int, settings: BoardSettings, travel: JointRange, limit: JointLimits
) -> messages.ConfigAxis:
    axis = settings.axes[number]
    scale = AxisScale(axis.units_per_mm)
    room_mm = settings.limit_tolerance_mm + settings.position_tolerance_mm
    fastest_mm_s = limit.velocity_mm_s * (1 + settings.speed_tolerance)
    return messages.ConfigAxis(
        axis=number,
        flags=_flags(axis, slide=settings.slide.encoder_reversed and number == 2),
        units_per_mm_q16=round(axis.units_per_mm * 65536),
        travel_min=math.floor((travel.min_mm - room_mm) * axis.units_per_mm),
        travel_max=math.ceil((travel.max_mm + room_mm) * axis.units_per_mm),
        switch_position=scale.units(travel.min_mm - axis.switch_below_travel_mm),
        max_rate=min(scale.rate(fastest_mm_s * (1 + ROUNDING)), (1 << 31) - 1),
        max_rate_jump=scale.rate(settings.velocity_tolerance_mm_s * (1 + ROUNDING)),
        stop_deceleration=scale.acceleration(axis.stop_deceleration_mm_s2),
        seek_rate=scale.rate(min(axis.seek_speed_mm_s, limit.velocity_mm_s)),
        locate_rate=scale.rate(min(axis.locate_speed_mm_s, limit.velocity_mm_s)),
        homing_acceleration=scale.acceleration(axis.homing_acceleration_mm_s2),
        back_off=scale.units(axis.back_off_mm),
        beyond_travel=scale.units(axis.beyond_travel_mm),
    )


def _flags(axis: AxisSettings, *, slide: bool) -> int:
    flags = AxisFlag(0)
    if axis.reversed:
        flags |= AxisFlag.REVERSED
    if axis.switch_closes:
        flags |= AxisFlag.SWITCH_CLOSES
    if slide:
        flags |= AxisFlag.ENCODER_REVERSED
    return int(flags)


def _slide(settings: BoardSettings) -> messages.ConfigRho3:
    slide = settings.slide
    scale = AxisScale(settings.rho3.units_per_mm)
    return messages.ConfigRho3(
        kp_q8=round(slide.kp_pwm_per_count * 256),
        ki_q16=round(slide.ki_pwm_per_count_s / 1000 * 65536),
        kd_q8=round(slide.kd_pwm_per_count_ms * 256),
        integral_pwm_max=slide.integral_pwm_max,
        friction_pwm=slide.friction_pwm,
        back_emf_q8=round(slide.back_emf_pwm_per_count_ms * 256),
        pwm_per_newton_q8=round(slide.pwm_per_newton * 256),
        force_limit_dn=round(slide.force_limit_n * 10),
        force_max_dn=round(slide.force_max_n * 10),
        stall_ms=round(slide.stall_s * 1000),
        following_error=min(scale.units(slide.following_error_mm), 0xFFFF),
        settled=max(min(scale.units(slide.settled_mm), 0xFFFF), 1),
        near=max(min(scale.units(slide.near_mm), 0xFFFF), 1),
    )
