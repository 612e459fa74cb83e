"""Steps, play and lag: how the joints follow what the board wants."""

from __future__ import annotations

import math

from drivers.simulator.parameters import DriveParameters
from twin.joints import JointPosition


def quantised(position_mm: float, per_mm: float) -> float:
    """The nearest whole step or encoder count [mm]."""
    return round(position_mm * per_mm) / per_mm


def with_play(output_mm: float, input_mm: float, width_mm: float) -> float:
    """The play operator: where a part stands that its drive moves through a gap.

    Args:
        output_mm: Where the part stood.
        input_mm: Where the drive stands now, having moved there without turning back.
        width_mm: Width of the gap; the drive moves that far before it takes the part back along.
    """
    half_mm = 0.5 * width_mm
    return min(max(output_mm, input_mm - half_mm), input_mm + half_mm)


def lagged(
    position_mm: float,
    target_mm: float,
    *,
    velocity_mm_s: float,
    acceleration_mm_s2: float,
    elapsed_s: float,
    lag_s: float,
) -> float:
    """First-order lag behind a target that moves with constant acceleration, exact.

    x' = (u - x) / tau with u = target + velocity t + acceleration t^2 / 2 has the solution
    x = u - tau u' + tau^2 u'' + c exp(-t / tau).

    Args:
        position_mm: x at the beginning.
        target_mm: u at the beginning.
        velocity_mm_s: u' at the beginning.
        acceleration_mm_s2: u''.
        elapsed_s: t.
        lag_s: tau.
    """
    curvature_mm = lag_s * lag_s * acceleration_mm_s2
    transient_mm = position_mm - (target_mm - lag_s * velocity_mm_s + curvature_mm)
    target_after_mm = target_mm + elapsed_s * (velocity_mm_s + 0.5 * acceleration_mm_s2 * elapsed_s)
    velocity_after_mm_s = velocity_mm_s + acceleration_mm_s2 * elapsed_s
    return (
        target_after_mm
        - lag_s * velocity_after_mm_s
        + curvature_mm
        + transient_mm * math.exp(-elapsed_s / lag_s)
    )


class StepperAxis:
    """One carriage: open-loop steps, then the play of gear and belt.

    Args:
        drives: Steps per millimetre.
        play_mm: Width of the play.
    """

    def __init__(self, drives: DriveParameters, play_mm: float) -> None:
        self._per_mm = drives.microsteps_per_mm
        self._play_mm = play_mm

    def counter(self, set_point_mm: float) -> float:
        """The step counter for a set point [mm]."""
        return quantised(set_point_mm, self._per_mm)

    def carriage(
        self,
        carriage_mm: float,
        zero_mm: float,
        *,
        start_mm: float,
        velocity_mm_s: float,
        acceleration_mm_s2: float,
        elapsed_s: float,
    ) -> float:
        """Where the carriage stands after its motor has followed one piece of the set point.

        Args:
            carriage_mm: Where it stood, in true coordinates.
            zero_mm: True position of the motor when its counter reads 0.
            start_mm: Set point at the beginning.
            velocity_mm_s: Its velocity at the beginning.
            acceleration_mm_s2: Its acceleration.
            elapsed_s: Duration.
        """
        turning_s = -velocity_mm_s / acceleration_mm_s2 if acceleration_mm_s2 else math.inf
        for t_s in (turning_s, elapsed_s):
            if 0 < t_s <= elapsed_s:
                reached_mm = start_mm + t_s * (velocity_mm_s + 0.5 * acceleration_mm_s2 * t_s)
                motor_mm = zero_mm + self.counter(reached_mm)
                carriage_mm = with_play(carriage_mm, motor_mm, self._play_mm)
        return carriage_mm


def encoder_reading(motor: JointPosition, drives: DriveParameters) -> JointPosition:
    """What the board measures of motor positions: step counters and the rho3 encoder [mm]."""
    return JointPosition(
        quantised(motor.rho1_mm, drives.microsteps_per_mm),
        quantised(motor.rho2_mm, drives.microsteps_per_mm),
        quantised(motor.rho3_mm, drives.encoder_counts_per_mm),
    )
