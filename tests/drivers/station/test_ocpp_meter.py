from __future__ import annotations

import pytest

from drivers.station.ocpp16.meter import read_meter


def sample(value: str, measurand: str, unit: str, phase: str = "") -> dict[str, str]:
    said = {"value": value, "measurand": measurand, "unit": unit}
    return said | ({"phase": phase} if phase else {})


def test_kilo_and_phases() -> None:
    reading = read_meter(
        [
            {"value": "7.5", "unit": "kWh"},
            sample("3.7", "Power.Active.Import", "kW"),
            sample("15.9", "Current.Import", "A", "L1"),
            sample("-2", "Current.Import", "A", "L3"),
            sample("0.2", "Current.Import", "A", "N"),
            sample("230", "Voltage", "V", "L1-N"),
        ]
    )
    assert reading.energy_wh == 7500.0
    assert reading.power_w == 3700.0
    assert reading.currents_a == (15.9, 0.0, 2.0)


def test_powers_of_phases_are_added_and_one_current_counts_for_all() -> None:
    reading = read_meter(
        [
            sample("1000", "Power.Active.Import", "W", "L1-N"),
            sample("500", "Power.Active.Import", "W", "L2-N"),
            sample("6", "Current.Import", "A"),
        ]
    )
    assert (reading.power_w, reading.currents_a) == (1500.0, (6.0, 6.0, 6.0))


def test_power_alone_stands_for_the_current() -> None:
    reading = read_meter([sample("2300", "Power.Active.Import", "W")])
    assert reading.shows_load
    assert reading.all_currents_a == (10.0, 0.0, 0.0)


def test_voltage_alone_says_nothing_about_load() -> None:
    assert not read_meter([sample("230", "Voltage", "V")]).shows_load
    assert not read_meter([sample("12", "Current.Import", "A", "N")]).shows_load


@pytest.mark.parametrize(
    "bad",
    [
        sample("nan", "Current.Import", "A"),
        sample("inf", "Power.Active.Import", "W"),
        sample("12 A", "Current.Import", "A"),
        sample("12", "Current.Import", "W"),
        sample("12", "Power.Active.Import", "MW"),
    ],
)
def test_what_is_no_value(bad: dict[str, str]) -> None:
    with pytest.raises((ValueError, KeyError)):
        read_meter([bad])
