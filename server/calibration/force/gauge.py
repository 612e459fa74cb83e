"""Friction, offset and scale of the force that the slide's motor current shows.

A slide that moves freely shows its friction, against its motion, and whatever the gauge is off:
with f_out and f_back the mean forces of cruising strokes,

    friction = (f_out - f_back) / 2,    offset = (f_out + f_back) / 2.

Pushed against a spring of a known rate k, force rises with the way by k times the gauge's scale,
whatever friction and offset are, and wherever the spring begins:

    scale = slope / k.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from statistics import median

import numpy as np
from numpy.typing import NDArray

from drivers.robot import RobotState
from server.calibration.axes.estimates import Estimate
from server.calibration.axes.following import FollowingWatch
from server.control.errors import ControlError
from twin.slide_pace import SlidePace

Array = NDArray[np.float64]

CRUISES = 0.9
"""Share of a stroke's top speed from which on acceleration does not show in the force."""
FEWEST = 8
LOWEST_SHARE, HIGHEST_SHARE = 0.25, 0.9
"""Of the largest force: between them the spring is certainly touched, and the slide still moves."""
SAMPLES = 5


@dataclass(slots=True)
class StrokeWatch:
    """Looks at every sample of a stroke; pass ``take`` as its watch.

    Attributes:
        end_at_n: A force of this size ends the stroke, unless it is what speeds the slide up.
        hit: What is raised then.
    """

    end_at_n: float
    hit: type[ControlError]
    following: FollowingWatch
    _samples: list[tuple[float, float, float]] = field(default_factory=list)
    _pace: SlidePace = field(default_factory=SlidePace)

    def take(self, state: RobotState) -> None:
        """Take in a sample.

        Raises:
            ControlError: the force is there: the stroke ends.
        """
        self.following.take(state)
        speed = state.commanded.velocity.rho3_mm_s
        rho3_mm = state.measured.position.rho3_mm
        self._samples.append((speed, rho3_mm, state.force_n))
        self._pace.take(state.sampled_at_s, state.commanded.position.rho3_mm, speed, rho3_mm)
        force_n = median(force for _, _, force in self._samples[-SAMPLES:])
        if self._pace.shows_too_much and abs(force_n) > self.end_at_n:
            raise self.hit(f"The slide meets {abs(force_n):.0f} N.", force_n=round(force_n, 1))

    @property
    def cruising(self) -> Array:
        """(rho3 [mm], force [N]) while the slide moved steadily, shape (n, 2)."""
        samples = np.array(self._samples).reshape(-1, 3)
        speed = np.abs(samples[:, 0])
        steady = speed >= CRUISES * speed.max(initial=math.inf if len(speed) == 0 else 0.0)
        return np.asarray(samples[steady & (speed > 0), 1:])


def friction_and_offset(
    out_n: Sequence[float], back_n: Sequence[float]
) -> tuple[Estimate, Estimate]:
    """Friction and offset from the mean forces of strokes.

    Raises:
        ValueError: there are fewer than two strokes each way.
    """
    out, back = np.asarray(out_n), np.asarray(back_n)
    if min(len(out), len(back)) < 2:
        raise ValueError("friction is measured with two strokes or more, there and back")
    sigma = 0.5 * math.sqrt(out.var(ddof=1) / len(out) + back.var(ddof=1) / len(back))
    return (
        Estimate(float(0.5 * (out.mean() - back.mean())), sigma),
        Estimate(float(0.5 * (out.mean() + back.mean())), sigma),
    )


def scale_by_spring(
    strokes: Sequence[Array], free_n: Sequence[float], spring_n_mm: float, spring_sigma: float
) -> Estimate:
    """Scale of the gauge from strokes against a spring.

    Args:
        strokes: (rho3 [mm], force [N]) of each, shape (n, 2).
        free_n: What each shows where it touches nothing [N].
        spring_n_mm: Rate of the spring.
        spring_sigma: How exactly that is known, as a share of it.

    Raises:
        ValueError: in none of them a force rises as a spring's does.
    """
    slopes, variances = [], []
    for stroke, level_n in zip(strokes, free_n, strict=True):
        force_n = stroke[:, 1] - level_n
        top_n = float(force_n.max(initial=0.0))
        pressed = (force_n > LOWEST_SHARE * top_n) & (force_n < HIGHEST_SHARE * top_n)
        if pressed.sum() < FEWEST:
            continue
        # force against way: the way is known to some counts, the force is what is noisy
        (slope, _), covariance = np.polyfit(stroke[pressed, 0], force_n[pressed], 1, cov=True)
        slopes.append(float(slope))
        variances.append(float(covariance[0, 0]))
    if not slopes or not min(slopes) > 0:
        raise ValueError("no force rises as a spring's does")
    scale = float(np.mean(slopes)) / spring_n_mm
    of_fit = math.sqrt(float(np.sum(variances))) / len(slopes) / spring_n_mm
    return Estimate(scale, math.hypot(of_fit, scale * spring_sigma))
