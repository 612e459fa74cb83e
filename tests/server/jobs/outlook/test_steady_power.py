"""Noise is averaged, a change of the power counts at once."""

from __future__ import annotations

import random

import pytest

from server.jobs.outlook.steady_power import SETTLES_S, SteadyPower


def test_nothing_is_told_while_the_power_still_rises() -> None:
    steady = SteadyPower()
    told = []
    for second, power_w in enumerate([0.0, 1400.0, 5200.0, 7300.0, 7350.0, 7330.0, 7360.0]):
        steady.read(power_w, float(second))
        told.append(steady.power_w)
    assert told[:-1] == [None] * 6
    assert told[-1] == pytest.approx(7330.0, abs=60.0)


def test_noise_hardly_shows() -> None:
    steady, chance = SteadyPower(), random.Random(1)
    told = []
    for second in range(300):
        steady.read(7360.0 * (1 + chance.gauss(0.0, 0.03)), float(second))
        if second > 60:
            assert steady.power_w is not None
            told.append(steady.power_w)
    assert (max(told) - min(told)) / 7360.0 < 0.03


def test_another_power_counts_as_soon_as_it_is_steady_and_the_old_one_until_then() -> None:
    steady = SteadyPower()
    for second in range(60):
        steady.read(11_000.0, float(second))
    steady.read(3_700.0, 60.0)
    assert steady.power_w == pytest.approx(11_000.0)
    steady.read(3_700.0, 60.0 + SETTLES_S)
    assert steady.power_w == pytest.approx(3_700.0)


def test_a_car_that_waits_has_no_power() -> None:
    steady = SteadyPower()
    for second in range(10):
        steady.read(7360.0, float(second))
    steady.read(20.0, 10.0)
    assert steady.power_w is None
    steady.read(7360.0, 9.0)  # a reading that is older than the newest
    assert steady.power_w is None
