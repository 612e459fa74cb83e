"""How exposure and gain follow the light."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest

from drivers.simulator.camera.auto_exposure import AutoExposure, fixed_setting
from drivers.simulator.camera.imaging import ImagingParameters

AUTOMATIC = ImagingParameters(automatic_exposure=True)


def total(exposures: AutoExposure, number: int) -> float:
    setting = exposures.at(number)
    return setting.exposure_s * setting.gain


def darkening_at(frame: int, light: float) -> AutoExposure:
    return AutoExposure(AUTOMATIC, lambda number: 1.0 if number < frame else light)


def test_it_is_fixed_unless_it_is_automatic() -> None:
    exposures = AutoExposure(ImagingParameters(), lambda number: 1.0 if number < 10 else 0.1)
    assert exposures.at(0) == exposures.at(500) == fixed_setting(ImagingParameters(), 1.0)
    assert exposures.at(0).gain == pytest.approx(3.0)


def test_it_answers_late_and_in_steps_and_arrives() -> None:
    exposures = darkening_at(40, 0.125)
    before = total(exposures, 39)
    stops = [math.log2(total(exposures, number) / before) for number in range(40, 80)]
    # frame 40 is measured by frame 44 at the earliest: 3 frames old, every 4th frame
    assert stops[:4] == pytest.approx([0.0] * 4)
    assert stops[4] == pytest.approx(1.0)
    steps = [after - at for at, after in pairwise(stops)]
    assert all(abs(step) <= 1 + 1e-9 for step in steps)
    assert all(step / 0.25 == pytest.approx(round(step / 0.25)) for step in steps)
    assert stops[-1] == pytest.approx(3.0, abs=0.25)
    assert stops[-1] == stops[-10]


def test_it_lengthens_the_exposure_before_it_raises_the_gain() -> None:
    dim = darkening_at(0, 0.5).at(100)
    assert dim.gain > 1.0
    assert dim.exposure_s == pytest.approx(AUTOMATIC.longest_exposure_s)
    bright = darkening_at(0, 50.0).at(100)
    assert bright.gain == 1.0
    assert AUTOMATIC.shortest_exposure_s <= bright.exposure_s < 0.002
    night = darkening_at(0, 0.0).at(100)
    assert night == (AUTOMATIC.longest_exposure_s, AUTOMATIC.most_gain)


def test_a_frame_is_exposed_alike_whichever_frames_were_looked_at() -> None:
    def light(number: int) -> float:
        return 0.4 if 50 <= number < 90 else 1.0

    often, once = AutoExposure(AUTOMATIC, light), AutoExposure(AUTOMATIC, light)
    settings = [often.at(number) for number in range(200)]
    assert once.at(199) == settings[199]
    assert often.at(60) == settings[60]  # also later
