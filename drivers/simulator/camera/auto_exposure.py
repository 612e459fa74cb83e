"""Exposure time and gain: fixed, or following the light in steps and with a delay."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable
from typing import NamedTuple

from drivers.simulator.camera.imaging import ImagingParameters

_NOMINAL_EXPOSURE_S = 0.008
_DARKEST = 1e-6
_REMEMBERED = 64


class ExposureSetting(NamedTuple):
    """How one frame is exposed."""

    exposure_s: float
    gain: float


def fixed_setting(imaging: ImagingParameters, light: float) -> ExposureSetting:
    """The configured exposure time, and the gain that somebody set for the usual light.

    Args:
        imaging: Limits and aims.
        light: The usual light; 1 is a normally lit garage.
    """
    white = imaging.exposed_white * light * imaging.exposure_s / _NOMINAL_EXPOSURE_S
    gain = imaging.target_white / max(white, _DARKEST)
    return ExposureSetting(imaging.exposure_s, min(max(gain, 1.0), imaging.most_gain))


class AutoExposure:
    """The setting of every frame.

    The automatic exposure acts on the light of a frame that is a few frames old, every few
    frames, by whole steps, and never by more than its largest change. It lengthens the exposure
    first and raises the gain when that is not enough. It measures the light on a white label, not
    the mean of the picture: so a frame's setting follows from its number and the light alone, and
    not from which frames somebody looked at.

    Args:
        imaging: How it works.
        light_of: Light on the car at frame n, n from 0.
    """

    def __init__(self, imaging: ImagingParameters, light_of: Callable[[int], float]) -> None:
        self._imaging = imaging
        self._light_of = light_of
        self._fixed = fixed_setting(imaging, light_of(0))
        step = imaging.exposure_step_stops
        start = round(self._wanted_stops(0) / step) * step
        self._stops: deque[tuple[int, float]] = deque([(0, start)], maxlen=_REMEMBERED)

    def at(self, number: int) -> ExposureSetting:
        """The setting of a frame; frames long gone have that of the oldest one remembered."""
        if not self._imaging.automatic_exposure:
            return self._fixed
        self._work_out(number // self._imaging.exposure_period_frames)
        period = number // self._imaging.exposure_period_frames
        known = (stops for at, stops in reversed(self._stops) if at <= period)
        return self._split(next(known, self._stops[0][1]))

    def _work_out(self, period: int) -> None:
        """Go on from the last period that is known, until nothing changes any more."""
        imaging = self._imaging
        at, stops = self._stops[-1]
        step, most = imaging.exposure_step_stops, imaging.exposure_most_stops
        first = max(at + 1, period - _REMEMBERED)  # a sleep of days ends settled
        for later in range(first, period + 1):
            measured = later * imaging.exposure_period_frames - imaging.exposure_delay_frames
            missing = self._wanted_stops(max(measured, 0)) - stops
            if abs(missing) > 0.75 * step:  # less would make it swing between two steps
                stops += min(max(round(missing / step) * step, -most), most)
                self._stops.append((later, stops))

    def _wanted_stops(self, number: int) -> float:
        """Binary logarithm of exposure times gain, over the nominal exposure at gain 1."""
        imaging = self._imaging
        white = imaging.exposed_white * max(self._light_of(number), _DARKEST)
        limits = (
            math.log2(imaging.shortest_exposure_s / _NOMINAL_EXPOSURE_S),
            math.log2(imaging.longest_exposure_s * imaging.most_gain / _NOMINAL_EXPOSURE_S),
        )
        return min(max(math.log2(imaging.target_white / white), limits[0]), limits[1])

    def _split(self, stops: float) -> ExposureSetting:
        imaging = self._imaging
        whole_s = _NOMINAL_EXPOSURE_S * 2.0**stops
        exposure_s = min(max(whole_s, imaging.shortest_exposure_s), imaging.longest_exposure_s)
        gain = min(max(whole_s / exposure_s, 1.0), imaging.most_gain)
        return ExposureSetting(exposure_s, gain)
