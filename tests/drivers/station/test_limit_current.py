"""Each station that can limit its current takes the limit in its own words."""

from __future__ import annotations

import asyncio
from typing import Any

import pytest

from drivers.station import StationUnsupportedError
from drivers.station.evcc import EvccStation
from drivers.station.goe import GoeStation
from drivers.station.managed import ManagedStation
from drivers.station.memory import StationMemory
from drivers.station.ocpp16 import OcppStation
from drivers.station.openevse import OpenevseStation
from drivers.station.settings import GoeSettings, OcppSettings
from tests.drivers.simulator.stand import PERFECT, Stand, on_stand
from tests.support.fake_stations.charge_point import FakeChargePoint
from tests.support.fake_stations.goe import FakeGoe
from tests.support.fake_stations.openevse import FakeOpenevse
from tests.support.fake_stations.serving import serving


async def test_an_openevse_keeps_the_limit_when_it_is_stopped_and_started(
    openevse: OpenevseStation, fake_openevse: FakeOpenevse
) -> None:
    assert openevse.capabilities.limits_current
    fake_openevse.plug(20.0)
    await openevse.limit_current(10.7)
    assert fake_openevse.override == {"auto_release": True, "charge_current": 10}
    await openevse.stop()
    assert fake_openevse.override == {
        "state": "disabled",
        "auto_release": False,
        "charge_current": 10,
    }
    await openevse.limit_current(16)
    assert fake_openevse.override["state"] == "disabled", "a limit starts nothing"
    await openevse.start()
    assert fake_openevse.override["charge_current"] == 16


async def test_a_go_e_takes_whole_amperes(memory: StationMemory) -> None:
    fake = FakeGoe()
    async with serving(fake.app) as url:
        goe = GoeStation(GoeSettings(url=url), memory)
        await goe.open()
        assert goe.capabilities.limits_current
        await goe.limit_current(13.9)
        assert fake.amp == 13
        await goe.close()


async def test_an_ocpp_station_gets_a_charging_profile(memory: StationMemory) -> None:
    settings = OcppSettings(host="127.0.0.1", port=0, charge_point="g")
    station, point = OcppStation(settings, memory), FakeChargePoint()
    await station.open()
    try:
        async with point.connected(f"ws://127.0.0.1:{station.port}/ocpp/g"):
            await station.limit_current(12)
            profile: dict[str, Any] = point.asked["SetChargingProfile"]
            assert profile["connectorId"] == 1
            schedule = profile["csChargingProfiles"]["chargingSchedule"]
            assert schedule["chargingRateUnit"] == "A"
            assert schedule["chargingSchedulePeriod"] == [{"startPeriod": 0, "limit": 12}]
            point.answers["SetChargingProfile"] = "NotSupported"
            with pytest.raises(StationUnsupportedError, match="smart charging"):
                await station.limit_current(12)
    finally:
        await station.close()


async def test_behind_a_manager_the_manager_decides(
    evcc: EvccStation, openevse: OpenevseStation
) -> None:
    managed = ManagedStation(evcc, openevse)
    assert not managed.capabilities.limits_current
    for driver in (managed, evcc):
        with pytest.raises(StationUnsupportedError, match="8 A"):
            await driver.limit_current(8)


async def test_a_managed_hold_says_how_long_it_may_take(
    evcc: EvccStation, openevse: OpenevseStation
) -> None:
    capabilities = ManagedStation(evcc, openevse, lets_go_s=10.0).capabilities
    assert capabilities.acts_within_s > 10.0 + openevse.capabilities.acts_within_s
    assert capabilities.reads_within_s > openevse.capabilities.reads_within_s
    assert openevse.capabilities.reads_within_s >= 2 * 3.0, "two calls of 3 s each"


def test_the_simulated_car_draws_what_it_may() -> None:
    async def scenario(stand: Stand) -> None:
        joints = await stand.align()
        await stand.insert(joints)
        await stand.station.limit_current(10)
        await stand.station.start()
        await asyncio.sleep(5.0)
        before = await stand.station.snapshot()
        assert before.currents_a[0] == pytest.approx(10.0, rel=0.02)
        await stand.station.limit_current(16)
        at_once = await stand.station.snapshot()
        assert at_once.currents_a[0] < 11.0, "it changes along a ramp"
        await asyncio.sleep(60.0)
        after = await stand.station.snapshot()
        assert after.currents_a[0] == pytest.approx(16.0, rel=0.02)
        charged_wh = after.session_energy_wh - before.session_energy_wh
        assert charged_wh == pytest.approx(16 * 230 / 60, rel=0.03)

    on_stand(scenario, parameters=PERFECT)
