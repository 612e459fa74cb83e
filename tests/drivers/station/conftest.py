from __future__ import annotations

from collections.abc import AsyncIterator

import pytest

from drivers.station.evcc import EvccStation
from drivers.station.memory import StationMemory
from drivers.station.openevse import OpenevseStation
from drivers.station.settings import EvccSettings, OpenevseSettings
from tests.support.fake_stations.evcc import FakeEvcc
from tests.support.fake_stations.openevse import FakeOpenevse
from tests.support.fake_stations.serving import serving


@pytest.fixture
def memory() -> StationMemory:
    return StationMemory()


@pytest.fixture
def fake_openevse() -> FakeOpenevse:
    return FakeOpenevse()


@pytest.fixture
async def openevse(
    fake_openevse: FakeOpenevse, memory: StationMemory
) -> AsyncIterator[OpenevseStation]:
    async with serving(fake_openevse.app) as url:
        station = OpenevseStation(OpenevseSettings(url=url, timeout_s=3.0), memory)
        await station.open()
        yield station
        await station.close()


@pytest.fixture
def fake_evcc(fake_openevse: FakeOpenevse) -> FakeEvcc:
    return FakeEvcc(fake_openevse)


@pytest.fixture
async def evcc_url(fake_evcc: FakeEvcc) -> AsyncIterator[str]:
    async with serving(fake_evcc.app) as url:
        yield url


@pytest.fixture
async def evcc(evcc_url: str, memory: StationMemory) -> AsyncIterator[EvccStation]:
    station = EvccStation(EvccSettings(url=evcc_url, loadpoint=2, timeout_s=3.0), memory)
    await station.open()
    yield station
    await station.close()
