"""A robot that does exactly what the model expects, and small changes of it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

from tests.support.slide_drive import driven
from twin.divergence import Sample
from twin.joints import JointPosition, JointVelocity

STEP_S = 0.01
START = JointPosition(150.0, 250.0, 60.0)


def sample(
    at_s: float = 0.0,
    *,
    measured: JointPosition = START,
    commanded: JointPosition = START,
    velocity: JointVelocity | None = None,
    force_n: float = 0.0,
    following: bool = True,
    running: bool = True,
    contact_known: bool = True,
) -> Sample:
    return Sample(
        at_s=at_s,
        measured=measured,
        commanded=commanded,
        velocity=velocity or JointVelocity(0.0, 0.0, 0.0),
        force_n=force_n,
        following=following,
        running=running,
        contact_known=contact_known,
    )


def slide_in(
    *,
    speed_mm_s: float = 14.0,
    distance_mm: float = 60.0,
    lag_s: float = 0.02,
    force_n: Callable[[float], float] = lambda _: 1.5,
    stuck_at_mm: float = math.inf,
) -> Iterator[Sample]:
    """The slide ramps up, moves and stops, as a first-order system far finer than the samples.

    Args:
        speed_mm_s: Of the set point.
        distance_mm: From START.
        lag_s: Of the slide.
        force_n: Force for a measured rho3.
        stuck_at_mm: The slide goes no further than this.
    """
    x = START.rho3_mm
    fine_s = 1e-4
    ramp_s = speed_mm_s / 100.0
    cruise_s = distance_mm / speed_mm_s - ramp_s
    steps = round((2 * ramp_s + cruise_s + 0.5) / fine_s)
    for step in range(steps + 1):
        t = step * fine_s
        u, v = _trapezoid(t, speed_mm_s, ramp_s, cruise_s)
        x = min(x + fine_s * (START.rho3_mm + u - x) / lag_s, stuck_at_mm)
        if step % round(STEP_S / fine_s) == 0:
            yield sample(
                t,
                measured=START._replace(rho3_mm=x),
                commanded=START._replace(rho3_mm=START.rho3_mm + u),
                velocity=JointVelocity(0.0, 0.0, v),
                force_n=force_n(x),
            )


def real_drive(load_n: Callable[[float], float], mass_n_s2_mm: float) -> Iterator[Sample]:
    """A slide that a control loop and a motor with a rotor move, from START."""
    for told in driven(load_n, way_mm=20.0, mass_n_s2_mm=mass_n_s2_mm):
        yield sample(
            told.at_s,
            measured=START._replace(rho3_mm=START.rho3_mm + told.measured_mm),
            commanded=START._replace(rho3_mm=START.rho3_mm + told.set_point_mm),
            velocity=JointVelocity(0.0, 0.0, told.speed_mm_s),
            force_n=told.force_n,
        )


def _trapezoid(t: float, speed: float, ramp_s: float, cruise_s: float) -> tuple[float, float]:
    """Way and velocity of a set point that ramps up, cruises and ramps down."""
    if t < ramp_s:
        return 0.5 * speed / ramp_s * t * t, speed * t / ramp_s
    if t < ramp_s + cruise_s:
        return speed * (t - 0.5 * ramp_s), speed
    left_s = max(2 * ramp_s + cruise_s - t, 0.0)
    way = speed * (cruise_s + ramp_s) - 0.5 * speed / ramp_s * left_s * left_s
    return way, speed * left_s / ramp_s
