from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError

import drivers.station
from drivers.registry import SIMULATOR, STATIONS, DeviceRequest, make_devices
from drivers.station.settings import HttpSettings, OcppSettings, OpenevseSettings
from server.config.settings import Settings
from server.config.station import StationSettings
from tests.drivers.station.test_http import SETTINGS

URL = "http://192.168.1.20"


@pytest.mark.parametrize(
    "url",
    ["192.168.1.20", "ftp://a", "http://", "http://me:secret@a", "http://a/?x=1", "http://a/#b"],
)
def test_an_address_that_cannot_be_used(url: str) -> None:
    with pytest.raises(ValidationError) as error:
        OpenevseSettings(url=url)
    assert "must" in str(error.value)


@pytest.mark.parametrize(
    "change",
    [
        {"start": None},
        {"password": None},
        {"login": "none"},
        {"status": "v2/state"},
        {"start": {"path": "/a", "body": "{on: true}"}},
        {"pilot": {"path": "a..b", "states": {"1": "A", "2": "B"}}},
        {"pilot": {"path": "a", "states": {"1": "A", "2": "G"}}},
        {"currents": []},
    ],
)
def test_a_description_that_does_not_work(change: dict[str, Any]) -> None:
    HttpSettings.model_validate({**SETTINGS, "url": URL})
    with pytest.raises(ValidationError):
        HttpSettings.model_validate({**SETTINGS, "url": URL, **change})


def test_secrets_do_not_show() -> None:
    http = HttpSettings.model_validate({**SETTINGS, "url": URL})
    ocpp = OcppSettings.model_validate({"charge_point": "garage", "password": "token-17"})
    for settings in (http, ocpp):
        assert "token-17" not in f"{settings!r} {settings.model_dump_json()}"


def test_every_driver_has_a_name_in_the_configuration() -> None:
    names = StationSettings.model_json_schema()["properties"]["driver"]["enum"]
    assert set(names) == set(STATIONS)


GROUPS: dict[str, Any] = {
    "openevse": {"url": URL},
    "evcc": {"url": URL},
    "goe": {"url": URL},
    "shelly": {"url": URL},
    "http": {**SETTINGS, "url": URL},
    "ocpp": {"charge_point": "garage"},
}


def device_request(driver: str, manager: str = "none") -> DeviceRequest:
    settings = Settings(station={"driver": driver, "manager": manager, **GROUPS})
    return DeviceRequest(
        robot="simulator",
        camera="simulator",
        station=settings.station.driver,
        port="auto",
        geometry=settings.geometry,
        limits=settings.motion,
        mount=settings.camera.mount,
        optics=settings.camera.optics,
        simulation=settings.simulation.parameters,
        seed=4,
        manager=settings.station.manager,
        stations=settings.station,
    )


@pytest.mark.parametrize("driver", GROUPS)
def test_each_driver_is_made_from_the_configuration(driver: str) -> None:
    assert set(GROUPS) == set(STATIONS) - {SIMULATOR}
    station = make_devices(device_request(driver)).station
    assert type(station).__name__.lower() == (driver + "station")
    assert station.name


@pytest.mark.parametrize("driver", ["openevse", "goe", "ocpp"])
def test_a_manager_goes_before_each_station(driver: str) -> None:
    station = make_devices(device_request(driver, "evcc")).station
    assert station.name.endswith("with evcc")
    assert station.capabilities.holds


@pytest.mark.parametrize(
    ("settings", "says"),
    [
        ({"driver": "openevse"}, "station.openevse"),
        ({"driver": "openevse", "openevse": {"url": URL}, "manager": "evcc"}, "station.evcc"),
        ({"driver": "evcc", "evcc": {"url": URL}, "manager": "evcc"}, "station behind it"),
        ({"manager": "evcc", "evcc": {"url": URL}}, "station behind it"),
    ],
)
def test_a_choice_without_its_settings(settings: dict[str, Any], says: str) -> None:
    with pytest.raises(ValidationError, match=says):
        StationSettings.model_validate(settings)


def test_a_manager_before_a_station() -> None:
    settings = StationSettings.model_validate(
        {
            "driver": "openevse",
            "manager": "evcc",
            "openevse": {"url": URL + "/"},
            "evcc": {"url": "http://192.168.1.30:7070", "loadpoint": 2},
        }
    )
    assert settings.openevse is not None
    assert settings.openevse.url == URL


def test_the_examples_in_the_description_work() -> None:
    description = (Path(drivers.station.__file__).parent / "README.md").read_text("utf-8")
    examples = re.findall(r"```toml\n(.*?)```", description, re.DOTALL)
    made = [Settings.model_validate(tomllib.loads(example)) for example in examples]
    assert {settings.station.driver for settings in made} == set(GROUPS) - {"evcc"}
