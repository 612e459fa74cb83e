from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.simulator.actuators import StepperAxis, encoder_reading, lagged, quantised, with_play
from drivers.simulator.parameters import DriveParameters
from twin.joints import JointPosition

positions = st.floats(-500, 500)
widths = st.floats(0, 2)


@given(positions, st.floats(1, 1000))
def test_a_quantised_position_is_a_whole_number_of_steps_within_half_a_step(
    position_mm: float, per_mm: float
) -> None:
    result = quantised(position_mm, per_mm)
    assert abs(result - position_mm) <= 0.5 / per_mm + 1e-9
    assert abs(result * per_mm - round(result * per_mm)) < 1e-6


def test_the_default_drive_steps_as_the_gear_and_pulley_say() -> None:
    # 1/16 steps give 453 microsteps per mm on this gear and pulley; the default is 1/8
    assert DriveParameters().microsteps_per_mm == pytest.approx(453.2 / 2, rel=1e-3)


@given(positions, positions, widths)
def test_play_never_leaves_the_part_further_than_half_the_gap(
    output: float, drive: float, width: float
) -> None:
    result = with_play(output, drive, width)
    assert abs(result - drive) <= width / 2 + 1e-9
    if abs(output - drive) <= width / 2:
        assert result == output


def test_turning_back_moves_the_part_only_after_the_whole_gap() -> None:
    loop = [0.0, 1.0, 2.0, 1.97, 1.96, 1.94, 1.0, 0.0, 0.03, 0.05, 0.06, 1.0]
    part, path = -0.025, []
    for drive in loop:
        part = with_play(part, drive, 0.05)
        path.append(round(part, 6))
    assert path == [
        -0.025, 0.975, 1.975, 1.975, 1.975, 1.965, 1.025, 0.025, 0.025, 0.025, 0.035, 0.975,
    ]  # fmt: skip


@given(positions, st.floats(-50, 50), st.floats(-400, 400), st.floats(-1, 1), st.floats(0, 0.05))
def test_the_lag_solves_its_differential_equation(
    target: float, velocity: float, acceleration: float, error: float, elapsed: float
) -> None:
    lag, steps = 0.02, 400
    x, dt = target + error, elapsed / steps
    for i in range(steps):  # midpoint rule on x' = (u - x) / tau

        def rate(t: float, at: float) -> float:
            return (target + velocity * t + 0.5 * acceleration * t * t - at) / lag

        middle = x + 0.5 * dt * rate(i * dt, x)
        x += dt * rate((i + 0.5) * dt, middle)
    exact = lagged(
        target + error,
        target,
        velocity_mm_s=velocity,
        acceleration_mm_s2=acceleration,
        elapsed_s=elapsed,
        lag_s=lag,
    )
    assert exact == pytest.approx(x, abs=1e-4)


def test_the_slide_follows_a_steady_motion_one_lag_behind() -> None:
    x = lagged(0.0, 0.0, velocity_mm_s=10.0, acceleration_mm_s2=0.0, elapsed_s=1.0, lag_s=0.02)
    assert x == pytest.approx(10.0 - 0.02 * 10.0, abs=1e-9)


def test_a_carriage_that_turns_within_one_piece_takes_up_the_play_at_the_turn() -> None:
    axis = StepperAxis(DriveParameters(microsteps_per_mm=1e6), 0.05)
    # 10 mm/s with -10 mm/s^2 turns after 1 s at 5 mm and is back at 0 after 2 s
    carriage = axis.carriage(
        0.0, 0.0, start_mm=0.0, velocity_mm_s=10.0, acceleration_mm_s2=-10.0, elapsed_s=1.005
    )
    assert carriage == pytest.approx(5.0 - 0.025, abs=1e-5)
    back = axis.carriage(
        0.0, 0.0, start_mm=0.0, velocity_mm_s=10.0, acceleration_mm_s2=-10.0, elapsed_s=2.0
    )
    assert back == pytest.approx(0.025, abs=1e-5)


def test_the_board_reads_steps_and_encoder_counts() -> None:
    drives = DriveParameters(microsteps_per_mm=10, encoder_counts_per_mm=4)
    reading = encoder_reading(JointPosition(1.04, 2.06, 3.2), drives)
    assert reading == pytest.approx((1.0, 2.1, 3.25))
    assert not math.isclose(reading.rho3_mm, 3.2)
