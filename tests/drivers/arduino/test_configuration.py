from __future__ import annotations

import pytest
from pydantic import ValidationError

from drivers.arduino.configuration import configuration_crc, configuration_messages
from drivers.arduino.protocol import messages
from drivers.arduino.protocol.messages import AxisFlag
from drivers.arduino.settings import AxisSettings, BoardSettings, SlideSettings
from drivers.registry import ROBOTS
from twin.geometry import RobotGeometry
from twin.motion import MotionLimits

SETTINGS = BoardSettings()


def axes_of(settings: BoardSettings) -> list[messages.ConfigAxis]:
    parts = configuration_messages(settings, RobotGeometry(), MotionLimits())
    return [part for part in parts if isinstance(part, messages.ConfigAxis)]


def test_the_carriages_can_be_as_fast_as_the_planner_wants() -> None:
    """80 mm/s are 18.1 kHz: less than one step per tick, more than half of one."""
    rho1 = axes_of(SETTINGS)[0]
    speed_mm_s = rho1.max_rate / 2**31 * 20_000 / SETTINGS.rho1.units_per_mm
    assert 80.8 <= speed_mm_s < 83
    assert 2**30 < rho1.max_rate < 2**31


def test_travel_and_switch_are_in_steps() -> None:
    rho1, _, rho3 = axes_of(SETTINGS)
    assert rho1.travel_min == pytest.approx(-0.015 * 226.6, abs=1)
    assert rho1.travel_max == pytest.approx(420.015 * 226.6, abs=1)
    assert rho3.travel_min < 50 * 93 < 150 * 93 < rho3.travel_max
    assert rho3.switch_position == round(49.5 * 93)
    assert rho1.stop_deceleration == pytest.approx(1500 * 226.6 * 2**31 / 20_000**2, rel=1e-4)


def test_flags_follow_the_wiring() -> None:
    settings = BoardSettings(
        rho1=AxisSettings(units_per_mm=100, reversed=True),
        rho2=AxisSettings(units_per_mm=100, switch_closes=True),
        slide=SlideSettings(encoder_reversed=True),
    )
    assert [AxisFlag(axis.flags) for axis in axes_of(settings)] == [
        AxisFlag.REVERSED,
        AxisFlag.SWITCH_CLOSES,
        AxisFlag.ENCODER_REVERSED,
    ]


def test_whatever_is_configured_changes_the_crc() -> None:
    variants = [
        SETTINGS,
        BoardSettings(rho2=AxisSettings(units_per_mm=226.7)),
        BoardSettings(slide=SlideSettings(kp_pwm_per_count=5)),
        BoardSettings(carriage_sum_mm=310),
    ]
    parts = [configuration_messages(v, RobotGeometry(), MotionLimits()) for v in variants]
    assert len({configuration_crc(part) for part in parts}) == len(variants)
    for part in parts:
        for message in part:
            assert type(message).unpack(message.pack()) == message, "every number fits"


def test_the_largest_settings_still_fit() -> None:
    slide = SlideSettings(
        kp_pwm_per_count=255,
        ki_pwm_per_count_s=999,
        kd_pwm_per_count_ms=255,
        back_emf_pwm_per_count_ms=255,
        pwm_per_newton=255,
        force_max_n=3000,
        stall_s=10,
        following_error_mm=1e6,
    )
    for part in configuration_messages(BoardSettings(slide=slide), RobotGeometry(), MotionLimits()):
        part.pack()


def test_a_force_limit_beyond_the_largest_is_refused() -> None:
    with pytest.raises(ValidationError, match="force_limit_n"):
        SlideSettings(force_limit_n=200, force_max_n=150)


def test_the_driver_can_be_chosen() -> None:
    assert "arduino" in ROBOTS
