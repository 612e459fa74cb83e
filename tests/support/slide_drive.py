"""The slide's drive as the motion board runs it: a control loop, and a rotor that has to be turned.

In newtons at the screw's nut, with friction and speed voltage fed forward exactly, as the firmware
does: what is left of the motor's force is m a plus what the plug meets. The gains are those of the
default settings, an eigenfrequency of 20 /s and a damping of 1 for a mass of 0.32 N s^2/mm.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterator
from typing import NamedTuple

COUNTS_PER_MM = 93.0
MASSES_N_S2_MM = (0.32, 0.55)
"""What the gains are made for, and a drive that is heavier and later than that."""

KP_N_MM, KD_N_S_MM, KI_N_MM_S = 128.0, 12.8, 1160.0
SPEED_WINDOW_MS = 16
STEP_S, SAMPLE_MS = 1e-3, 10
STARTS_S = 0.2


class DriveSample(NamedTuple):
    """What the board tells every 10 ms.

    Attributes:
        at_s: When.
        set_point_mm: Way of the set point.
        speed_mm_s: Its speed.
        measured_mm: Way of the slide by its encoder.
        force_n: Of the motor.
        load_n: What the plug really meets; no board knows it.
    """

    at_s: float
    set_point_mm: float
    speed_mm_s: float
    measured_mm: float
    force_n: float
    load_n: float


def driven(
    load_n: Callable[[float], float],
    *,
    way_mm: float,
    speed_mm_s: float = 14.0,
    mass_n_s2_mm: float = MASSES_N_S2_MM[0],
    cap_n: float = 80.0,
) -> Iterator[DriveSample]:
    """A motion from rest that then goes on at one speed; ways and forces count along it.

    Args:
        load_n: What the plug meets after a way [mm], against the motion.
        way_mm: It ends when the set point is there.
        speed_mm_s: Of the set point, once it is up.
        mass_n_s2_mm: Of everything that moves, at the nut.
        cap_n: The motor pushes no harder.
    """
    x_mm = v_mm_s = u_mm = integral_n = 0.0
    counts = deque([0] * (SPEED_WINDOW_MS + 1), maxlen=SPEED_WINDOW_MS + 1)
    millisecond = 0
    while u_mm < way_mm:
        share = min(millisecond * STEP_S / STARTS_S, 1.0)
        u_speed_mm_s = speed_mm_s * share * share * (3 - 2 * share)
        u_mm += u_speed_mm_s * STEP_S
        counts.append(math.floor(x_mm * COUNTS_PER_MM))
        measured_mm = (counts[-1] + 0.5) / COUNTS_PER_MM
        seen_mm_s = (counts[-1] - counts[0]) / COUNTS_PER_MM / (SPEED_WINDOW_MS * STEP_S)
        wanted_n = KP_N_MM * (u_mm - measured_mm) + KD_N_S_MM * (u_speed_mm_s - seen_mm_s)
        force_n = max(-cap_n, min(wanted_n + integral_n, cap_n))
        if abs(wanted_n + integral_n) < cap_n:
            integral_n += KI_N_MM_S * (u_mm - measured_mm) * STEP_S
        against_n = load_n(x_mm)
        v_mm_s = max(v_mm_s + (force_n - against_n) / mass_n_s2_mm * STEP_S, 0.0)
        x_mm += v_mm_s * STEP_S
        if millisecond % SAMPLE_MS == 0:
            at_s = millisecond * STEP_S
            yield DriveSample(at_s, u_mm, u_speed_mm_s, measured_mm, force_n, against_n)
        millisecond += 1
