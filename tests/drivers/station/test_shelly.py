from __future__ import annotations

from collections.abc import AsyncIterator
from typing import Any

import pytest

from drivers.station import (
    PilotState,
    StationAnswerError,
    StationLoginError,
    StationUnsupportedError,
)
from drivers.station.settings import ShellySettings
from drivers.station.shelly import ShellyStation
from tests.support.fake_stations.serving import serving
from tests.support.fake_stations.shelly import FakeShelly

PASSWORD = "staple, battery"  # noqa: S105 - of the fake


@pytest.fixture
def fake() -> FakeShelly:
    return FakeShelly(PASSWORD)


@pytest.fixture
async def shelly(fake: FakeShelly) -> AsyncIterator[ShellyStation]:
    async with serving(fake.app) as url:
        settings = {"url": url, "password": PASSWORD, "car_input": 0, "timeout_s": 3.0}
        station = ShellyStation(ShellySettings.model_validate(settings))
        await station.open()
        yield station
        await station.close()


async def test_a_whole_charging(shelly: ShellyStation, fake: FakeShelly) -> None:
    snapshot = await shelly.snapshot()
    assert (snapshot.pilot, snapshot.enabled) == (PilotState.A, False)
    fake.connected = True
    assert (await shelly.snapshot()).pilot is PilotState.B
    await shelly.start()
    fake.total_wh += 250.0
    snapshot = await shelly.snapshot()
    assert (snapshot.pilot, snapshot.currents_a) == (PilotState.C, (10.1, 0.0, 0.0))
    assert snapshot.session_energy_wh == 250.0
    await shelly.stop()
    snapshot = await shelly.snapshot()
    assert (snapshot.enabled, snapshot.carries_load) == (False, False)
    await shelly.hold()
    await shelly.release()
    assert not fake.output


async def test_a_counter_that_was_reset_counts_again(
    shelly: ShellyStation, fake: FakeShelly
) -> None:
    fake.connected = True
    await shelly.snapshot()
    fake.total_wh = 0.0
    assert (await shelly.snapshot()).session_energy_wh == 0.0
    fake.total_wh = 3.0
    assert (await shelly.snapshot()).session_energy_wh == 3.0


async def test_without_an_input_no_plug_is_believed_to_be_out() -> None:
    fake = FakeShelly()
    async with serving(fake.app) as url:
        station = ShellyStation(ShellySettings(url=url))
        await station.open()
        assert (await station.snapshot()).pilot is PilotState.B
        assert not station.capabilities.senses_car
        assert not station.capabilities.holds
        with pytest.raises(StationUnsupportedError):
            await station.unlock()
        await station.close()


async def test_a_wrong_password_is_told() -> None:
    async with serving(FakeShelly(PASSWORD).app) as url:
        settings = ShellySettings.model_validate({"url": url, "password": "another"})
        station = ShellyStation(settings)
        with pytest.raises(StationLoginError):
            await station.open()
        await station.close()


async def test_a_hot_relay_is_a_fault(shelly: ShellyStation, fake: FakeShelly) -> None:
    fake.fields = {"errors": ["overtemp"]}
    assert (await shelly.snapshot()).pilot is PilotState.F


@pytest.mark.parametrize(
    "fields", [{"output": 1}, {"current": None}, {"apower": "0"}, {"aenergy": None}]
)
async def test_nonsense_is_no_reading(
    shelly: ShellyStation, fake: FakeShelly, fields: dict[str, Any]
) -> None:
    fake.fields = fields
    with pytest.raises(StationAnswerError):
        await shelly.snapshot()


async def test_an_input_that_is_a_button_is_told(shelly: ShellyStation, fake: FakeShelly) -> None:
    fake.input = None
    with pytest.raises(StationAnswerError, match="Switch"):
        await shelly.snapshot()
