"""Limits of forces that must agree: those of a job, of the actuators and of the motion board.

insertion limits <= actuators.rho3_n <= robot.board.slide.force_max_n
"""

from __future__ import annotations

import math

from drivers.arduino.settings import SlideSettings
from server.config.insertion import InsertionSettings
from twin.geometry import RobotGeometry
from twin.statics import LoadCase, Loads
from twin.statics.loads import GRAVITY_M_S2, slide_thrust_n


def loads_at_limits(loads: Loads, insertion: InsertionSettings) -> Loads:
    """The loads with the largest forces that a job may put on the plug."""
    return loads.model_copy(
        update={
            "insertion_force_n": insertion.force_limit_n,
            "withdrawal_force_n": insertion.withdrawal_force_limit_n,
        }
    )


def force_conflict(
    *,
    geometry: RobotGeometry,
    loads: Loads,
    insertion: InsertionSettings,
    strongest_n: float,
    slide: SlideSettings,
    simulated_motor_n: float | None,
) -> str | None:
    """The first limit that contradicts another in a sentence with both names; None if all agree.

    Args:
        geometry: The robot; a part of the weight on its slide adds to the force.
        loads: Masses.
        insertion: Limits of a job.
        strongest_n: actuators.rho3_n.
        slide: Limits of the motion board.
        simulated_motor_n: What the simulated motor can do; None with a real one.
    """
    loads = loads_at_limits(loads, insertion)
    weight_n = GRAVITY_M_S2 * loads.on_slide_kg * abs(math.sin(geometry.theta_rad))
    for name, limit_n, case in (
        ("force_limit_n", insertion.force_limit_n, LoadCase.INSERTING),
        ("withdrawal_force_limit_n", insertion.withdrawal_force_limit_n, LoadCase.WITHDRAWING),
    ):
        thrust_n = abs(slide_thrust_n(geometry, loads, case))
        if thrust_n > strongest_n:
            return (
                f"insertion.{name} = {limit_n:g} N takes {thrust_n:.1f} N of the slide "
                f"({weight_n:.1f} N is the weight on it), but actuators.rho3_n is "
                f"{strongest_n:g} N; lower the limit or fit a stronger drive"
            )
        if limit_n > slide.force_max_n:
            return (
                f"insertion.{name} = {limit_n:g} N is more than robot.board.slide.force_max_n = "
                f"{slide.force_max_n:g} N, with which the board would stop the slide before"
            )
    if slide.force_limit_n > strongest_n:
        return (
            f"robot.board.slide.force_limit_n = {slide.force_limit_n:g} N, which holds after a "
            f"start, is more than actuators.rho3_n = {strongest_n:g} N"
        )
    if strongest_n > slide.force_max_n:
        return (
            f"actuators.rho3_n = {strongest_n:g} N is more than robot.board.slide.force_max_n = "
            f"{slide.force_max_n:g} N: the board never lets the slide push that hard"
        )
    if simulated_motor_n is not None and strongest_n > simulated_motor_n:
        return (
            f"actuators.rho3_n = {strongest_n:g} N is more than the simulated motor can do: "
            f"simulation.parameters.drives.max_force_n = {simulated_motor_n:g} N"
        )
    return None
