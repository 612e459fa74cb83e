"""What the energy costs: by the hour, over midnight, over the change of the clocks."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from types import SimpleNamespace
from typing import cast
from unittest.mock import Mock
from zoneinfo import ZoneInfo

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from server.config.settings import Settings
from server.config.tariff import TariffSettings
from server.jobs.context import JobContext
from server.jobs.cost import CostMeter, mean_price, price_at
from server.jobs.journal import Journal
from server.jobs.model import JobPhase, JobState, JobType
from server.schema.jobs import JobResult
from tests.support.garage import Scene
from tests.support.knowing_eye import on_knowing_scene

ROME = ZoneInfo("Europe/Rome")


def tariff(*windows: tuple[str, str, float], price: float = 0.30) -> TariffSettings:
    return TariffSettings.model_validate(
        {
            "currency": "EUR",
            "price_per_kwh": price,
            "time_zone": "Europe/Rome",
            "windows": [
                {"begin": begin, "end": end, "price_per_kwh": each} for begin, end, each in windows
            ],
        }
    )


NIGHT = tariff(("22:00", "06:00", 0.20), ("12:00", "14:00", 0.10))


def rome(day: int, hour: int, minute: int = 0, month: int = 1) -> datetime:
    return datetime(2026, month, day, hour, minute, tzinfo=ROME)


@pytest.mark.parametrize(
    ("clock", "price"),
    [
        ((0, 0), 0.20),
        ((5, 59), 0.20),
        ((6, 0), 0.30),
        ((11, 59), 0.30),
        ((12, 0), 0.10),
        ((13, 59), 0.10),
        ((14, 0), 0.30),
        ((21, 59), 0.30),
        ((22, 0), 0.20),
        ((23, 59), 0.20),
    ],
)
def test_each_hour_has_its_price(clock: tuple[int, int], price: float) -> None:
    assert price_at(NIGHT, rome(15, *clock).astimezone(UTC)) == price


def test_energy_over_a_border_is_divided_by_time() -> None:
    # A quarter before 22:00 at 0.30, three quarters after it at 0.20.
    assert mean_price(NIGHT, rome(15, 21, 45), rome(15, 22, 45)) == pytest.approx(0.225)
    # The whole night and two hours at both ends.
    assert mean_price(NIGHT, rome(15, 20), rome(16, 8)) == pytest.approx((4 * 0.3 + 8 * 0.2) / 12)


def test_the_night_of_the_clock_change_has_its_real_length() -> None:
    # On 29 March 2026 the clock jumps from 2 to 3: the night is 7 hours long.
    begin, end = rome(28, 22, month=3).astimezone(UTC), rome(29, 8, month=3).astimezone(UTC)
    assert end - begin == timedelta(hours=9)
    assert mean_price(NIGHT, begin, end) == pytest.approx((7 * 0.2 + 2 * 0.3) / 9)


@given(
    begin_min=st.integers(0, 3 * 24 * 60),
    span_min=st.integers(1, 3 * 24 * 60),
    cut=st.floats(0.01, 0.99),
)
def test_reading_in_between_changes_nothing(begin_min: int, span_min: int, cut: float) -> None:
    begin = datetime(2026, 10, 24, tzinfo=UTC) + timedelta(minutes=begin_min)
    span = timedelta(minutes=span_min)
    whole = CostMeter(NIGHT, energy_wh=0, cost=0, at=begin)
    whole.read(10_000, begin + span)
    parts = CostMeter(NIGHT, energy_wh=0, cost=0, at=begin)
    parts.read(10_000 * cut, begin + cut * span)
    parts.read(10_000, begin + span)
    assert parts.cost == pytest.approx(whole.cost, abs=1e-6)
    assert 1.0 - 1e-9 <= whole.cost <= 3.0 + 1e-9


def test_a_meter_that_does_not_count_on_costs_nothing() -> None:
    meter = CostMeter(NIGHT, energy_wh=500, cost=1.0, at=rome(15, 10))
    meter.read(400, rome(15, 11))
    meter.read(500, rome(15, 12))
    assert meter.cost == 1.0
    meter.read(1500, rome(15, 12, 30))
    assert meter.cost == pytest.approx(1.1)


@pytest.mark.parametrize(
    ("windows", "sentence"),
    [
        ([("22:00", "22:00", 0.1)], "the same time"),
        ([("22:00", "06:00", 0.1), ("05:00", "07:00", 0.2)], "two windows contain 05:00"),
        ([("10:00", "12:00", 0.1), ("10:00", "11:00", 0.2)], "two windows contain 10:00"),
    ],
)
def test_windows_that_contradict_each_other_are_refused(
    windows: list[tuple[str, str, float]], sentence: str
) -> None:
    with pytest.raises(ValidationError, match=sentence):
        tariff(*windows)


def test_windows_may_touch_and_fill_the_day() -> None:
    whole = tariff(("00:00", "12:00", 0.1), ("12:00", "00:00", 0.2))
    assert price_at(whole, rome(1, 0)) == 0.1
    assert price_at(whole, rome(1, 23, 59)) == 0.2


@pytest.mark.parametrize("zone", ["Europe/Atlantis", "../etc/passwd", ""])
def test_unknown_time_zone_is_refused(zone: str) -> None:
    with pytest.raises(ValidationError, match="time zone"):
        TariffSettings(currency="EUR", time_zone=zone)


def test_a_charge_says_what_it_costs() -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.carried_out(JobType.CHARGE, energy_wh=50.0)
        assert job.state is JobState.SUCCEEDED
        assert job.result.energy_wh is not None
        assert job.result.cost == pytest.approx(job.result.energy_wh / 1000 * 0.30, abs=1e-3)
        assert job.result.currency == "EUR"

    on_knowing_scene(scenario, settings=Settings(tariff=tariff()))


def test_without_a_currency_there_is_no_cost() -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.carried_out(JobType.CHARGE, energy_wh=50.0)
        assert job.result.cost is None
        assert job.result.currency is None

    on_knowing_scene(scenario)


def test_a_pause_neither_costs_nor_loses_anything() -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.start(JobType.CHARGE, 60.0)
        await scene.until_phase(JobPhase.CHARGING)
        await scene.later(15.0)
        await scene.services.runner.pause(job.id)
        await scene.later(40.0)
        await scene.services.runner.resume(job.id)
        ended = await scene.ended(job)
        assert ended.state is JobState.SUCCEEDED
        assert (ended.result.energy_wh or 0.0) >= 55.0
        price = (ended.result.energy_wh or 0.0) * 0.30e-3
        assert ended.result.cost == pytest.approx(price, abs=1e-3)

    on_knowing_scene(scenario, seed=4, settings=Settings(tariff=tariff()))


def test_what_flowed_while_nobody_looked_is_counted_when_the_job_goes_on() -> None:
    kept = JobResult(energy_wh=1000.0, cost=0.30, currency="EUR", cost_at=rome(15, 21))
    journal = SimpleNamespace(job=SimpleNamespace(result=kept))
    job = JobContext(
        supervisor=Mock(),
        lease=Mock(),
        eye=Mock(),
        station=Mock(),
        vehicle=None,
        settings=Settings(tariff=NIGHT),
        journal=cast("Journal", journal),
        accepted_at_s=0.0,
        start=Mock(),
        calendar=Mock(),
    )
    job.count_cost()
    assert job.cost is not None
    job.cost.read(3000.0, rome(15, 23))  # an hour at 0.30, an hour at 0.20
    assert job.cost_so_far == {"cost": 0.80, "currency": "EUR", "cost_at": rome(15, 23)}
