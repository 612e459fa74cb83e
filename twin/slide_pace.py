"""When the force of the slide's motor is the force on the plug, judged by how the slide moves.

The force is worked out from the motor's current, and what the motor turns takes its share of that:
with the slide's acceleration a, and with m for rotor, screw and slide as they are felt at the nut,

    F_motor = F_plug + m a.

The screw makes m large: on the reference drive 100 mm/s^2 take 30 to 60 N. So a force speaks of the
plug only while the slide does not accelerate. How its set point moves does not say that: a slide
that was late goes on speeding up when its set point has long been steady, and swings after that.

The two signs of a are not alike. While the slide speeds up, a force that seems too large may be the
motor's own. While it slows down, something holds it that is stronger than the motor shows, so a
force that is too large counts: whatever really hinders the plug, and so slows it down, counts from
its first sample. A force that is too small does no harm, so that one waits until the slide has
stopped swinging, too.
"""

from __future__ import annotations

import math
from collections import deque
from statistics import fmean
from typing import NamedTuple

SAMPLES = 9
"""Looked at together: 80 ms of a moving robot, two halves of 40 ms."""

STEADY_MM_S = 0.8
"""A smaller change of speed from half to half is none. The encoder's counts alone make 0.5 of it
at the most; all of it is 20 mm/s^2."""

SLOWEST_MM_S = 1.0
"""Slower than this a slide sticks and slips, and its force says nothing."""


class _Moment(NamedTuple):
    at_s: float
    speed_mm_s: float
    lag_mm: float


class SlidePace:
    """Compares how fast the slide was with how fast it is, over the newest samples."""

    def __init__(self) -> None:
        self._moments: deque[_Moment] = deque(maxlen=SAMPLES)
        self._even = 0

    def take(self, at_s: float, set_point_mm: float, speed_mm_s: float, measured_mm: float) -> None:
        """Take in a sample.

        Args:
            at_s: When.
            set_point_mm: Of rho3.
            speed_mm_s: Of the set point, positive towards the car.
            measured_mm: rho3 by the encoder at the same instant.
        """
        self._moments.append(_Moment(at_s, speed_mm_s, set_point_mm - measured_mm))
        even = self._told and abs(self._sped_up_mm_s) < STEADY_MM_S
        self._even = self._even + 1 if even else 0

    def reset(self) -> None:
        """What comes next has nothing to do with what was before."""
        self._moments.clear()
        self._even = 0

    @property
    def shows_too_much(self) -> bool:
        """Whether a force that is too large against the motion is the plug's."""
        return self._told and self._sped_up_mm_s < STEADY_MM_S

    @property
    def shows_too_little(self) -> bool:
        """Whether a force that is too small against the motion is the plug's."""
        return self._even >= SAMPLES

    @property
    def _told(self) -> bool:
        """The set point has moved one way in all samples."""
        speeds = [moment.speed_mm_s for moment in self._moments]
        full = len(speeds) == SAMPLES
        return full and (min(speeds) > SLOWEST_MM_S or max(speeds) < -SLOWEST_MM_S)

    @property
    def _sped_up_mm_s(self) -> float:
        """By how much the slide is faster in the newer half than in the older one."""
        moments = list(self._moments)
        middle = SAMPLES // 2
        older, newer = (_speed_mm_s(half) for half in (moments[: middle + 1], moments[middle:]))
        return math.copysign(1.0, moments[-1].speed_mm_s) * (newer - older)


def _speed_mm_s(moments: list[_Moment]) -> float:
    """Of the slide: that of its set point, less what the lag has grown.

    The two are of one instant, so that it does not matter how exactly the instant is known.
    """
    first, last = moments[0], moments[-1]
    lasts_s = last.at_s - first.at_s
    grown_mm_s = (last.lag_mm - first.lag_mm) / lasts_s if lasts_s > 0 else 0.0
    return fmean(moment.speed_mm_s for moment in moments) - grown_mm_s
