from __future__ import annotations

import asyncio
import base64
from collections.abc import AsyncIterator

import pytest
from websockets.exceptions import InvalidStatus

from drivers.station import (
    PilotState,
    StationHeldError,
    StationNotOpenError,
    StationRefusedError,
    StationSilentError,
    StationStaleError,
    StationUnreachableError,
    StationUnsupportedError,
)
from drivers.station.memory import StationMemory
from drivers.station.ocpp16 import OcppStation
from drivers.station.settings import OcppSettings
from tests.support.eventually import eventually
from tests.support.fake_stations.charge_point import FakeChargePoint

SETTINGS = OcppSettings(host="127.0.0.1", port=0, charge_point="garage-evse", timeout_s=3.0)


def url_of(station: OcppStation, identity: str = "garage-evse") -> str:
    return f"ws://127.0.0.1:{station.port}/ocpp/{identity}"


@pytest.fixture
async def station(memory: StationMemory) -> AsyncIterator[OcppStation]:
    station = OcppStation(SETTINGS, memory)
    await station.open()
    yield station
    await station.close()


@pytest.fixture
async def point(station: OcppStation) -> AsyncIterator[FakeChargePoint]:
    point = FakeChargePoint()
    async with point.connected(url_of(station)):
        yield point


async def charge(station: OcppStation, point: FakeChargePoint) -> None:
    point.plugged = True
    await point.tell_status()
    await station.start()
    await eventually(lambda: point.transaction is not None)


async def stop(station: OcppStation, point: FakeChargePoint) -> None:
    await station.stop()
    await eventually(lambda: point.transaction is None)


async def test_the_recorded_way_from_plug_to_unplug(
    station: OcppStation, point: FakeChargePoint
) -> None:
    assert (await station.snapshot()).pilot is PilotState.A
    await charge(station, point)
    point.energy_wh = 21
    charging = await station.snapshot()
    assert (charging.pilot, charging.contactor_closed) == (PilotState.C, True)
    assert charging.currents_a == (16.0, 16.0, 16.0)
    assert (charging.power_w, charging.session_energy_wh) == (11040.0, 21.0)
    await stop(station, point)
    stopped = await station.snapshot()
    assert (stopped.pilot, stopped.enabled, stopped.carries_load) == (PilotState.B, False, False)
    await station.hold()
    held = await station.snapshot()
    assert held.held
    assert held.pilot is PilotState.B, "an unavailable connector hides the plug"
    with pytest.raises(StationUnsupportedError, match="unlocks = false"):
        await station.unlock()
    with pytest.raises(StationHeldError):
        await station.start()
    point.plugged = False
    await station.release()
    released = await station.snapshot()
    assert (released.pilot, released.held) == (PilotState.A, False)
    assert "ChangeConfiguration" in point.heard


async def test_samples_are_fresh(station: OcppStation, point: FakeChargePoint) -> None:
    before_s = asyncio.get_running_loop().time()
    first = await station.snapshot()
    second = await station.snapshot()
    assert before_s <= first.sampled_at_s < second.sampled_at_s
    assert point.heard.count("TriggerMessage") == 4


async def test_values_sent_late_do_not_replace_newer_ones(
    station: OcppStation, point: FakeChargePoint
) -> None:
    await charge(station, point)
    await station.snapshot()
    await point.tell_meter(age_s=600.0, amps=0.0)
    point.answers["TriggerMessage"] = "Rejected"
    assert (await station.snapshot()).currents_a[0] == 16.0


async def test_a_clock_set_back_makes_everything_stale_one_set_ahead_does_not(
    station: OcppStation, point: FakeChargePoint, monkeypatch: pytest.MonkeyPatch
) -> None:
    point.clock_ahead_s = 3600.0
    await station.snapshot()
    point.clock_ahead_s = 0.0
    monkeypatch.setattr(station, "_settings", SETTINGS.model_copy(update={"timeout_s": 0.3}))
    with pytest.raises(StationStaleError, match="clock is wrong"):
        await station.snapshot()


async def test_without_triggers_a_reading_grows_old(
    station: OcppStation, point: FakeChargePoint
) -> None:
    point.answers["TriggerMessage"] = "NotImplemented"
    with pytest.raises(StationStaleError, match="not told"):
        await station.snapshot()
    await point.tell_meter()
    first = await station.snapshot()
    assert await station.snapshot() == first
    assert point.heard.count("TriggerMessage") == 2


async def test_a_refusal_is_told(station: OcppStation, point: FakeChargePoint) -> None:
    point.answers["ChangeAvailability"] = "Rejected"
    point.answers["UnlockConnector"] = "UnlockFailed"
    with pytest.raises(StationRefusedError, match="ChangeAvailability"):
        await station.hold()
    with pytest.raises(StationRefusedError, match="UnlockFailed"):
        await station.unlock()
    with pytest.raises(StationHeldError):
        await station.start()


async def test_a_transaction_that_ended_unheard_is_forgotten(
    station: OcppStation, point: FakeChargePoint
) -> None:
    await charge(station, point)
    point.transaction = None
    await station.stop()
    await station.stop()
    assert point.heard.count("RemoteStopTransaction") == 1


async def test_a_transaction_survives_the_end_of_the_process(memory: StationMemory) -> None:
    point = FakeChargePoint()
    for life in (1, 2):
        station = OcppStation(SETTINGS, memory)
        await station.open()
        async with point.connected(url_of(station)):
            if life == 1:
                await charge(station, point)
            else:
                await stop(station, point)
                await charge(station, point)
                assert point.transaction == 2
        await station.close()


async def test_a_station_that_goes_silent(memory: StationMemory) -> None:
    station = OcppStation(SETTINGS.model_copy(update={"timeout_s": 0.3}), memory)
    await station.open()
    point = FakeChargePoint()
    async with point.connected(url_of(station)):
        point.silent_triggers = True
        with pytest.raises(StationSilentError, match="did not send it"):
            await station.snapshot()
        point.deaf = True
        with pytest.raises(StationSilentError, match="did not answer"):
            await station.snapshot()
    await station.close()


async def test_a_dropped_connection_is_unknown_until_it_is_back(station: OcppStation) -> None:
    point = FakeChargePoint()
    with pytest.raises(StationUnreachableError, match="ws://"):
        await station.snapshot()
    async with point.connected(url_of(station)):
        await station.snapshot()
    await eventually(lambda: not station.connected.is_set())
    with pytest.raises(StationUnreachableError):
        await station.snapshot()
    async with point.connected(url_of(station)):
        await station.snapshot()


@pytest.mark.parametrize(
    "message", ["<html>", "[]", "[2]", '[2,"1","Nonsense",{}]', '[3,"unknown",{}]', "{}", "7"]
)
async def test_nonsense_leaves_nothing_believed(
    station: OcppStation, point: FakeChargePoint, message: str
) -> None:
    await station.snapshot()
    await point.send(message)
    try:
        assert (await station.snapshot()).pilot is PilotState.A
    except StationUnreachableError:
        assert not station.connected.is_set()


async def test_meter_values_that_make_no_sense(
    station: OcppStation, point: FakeChargePoint
) -> None:
    point.samples = [{"value": "NaN", "measurand": "Current.Import", "unit": "A"}]
    point.answers["TriggerMessage"] = "NotImplemented"
    await point.tell_meter()
    with pytest.raises(StationStaleError, match="MeterValues"):
        await station.snapshot()


async def test_only_our_station_may_come_in(memory: StationMemory) -> None:
    settings = SETTINGS.model_validate(SETTINGS.model_dump() | {"password": "key-4711"})
    station = OcppStation(settings, memory)
    await station.open()
    good = "Basic " + base64.b64encode(b"garage-evse:key-4711").decode()
    with pytest.raises(InvalidStatus, match="404"):
        async with FakeChargePoint().connected(url_of(station, "another"), good):
            pass
    with pytest.raises(InvalidStatus, match="401"):
        async with FakeChargePoint().connected(url_of(station)):
            pass
    async with FakeChargePoint().connected(url_of(station), good):
        await station.snapshot()
    await station.close()


async def test_a_taken_port_is_told(station: OcppStation, memory: StationMemory) -> None:
    other = OcppStation(SETTINGS.model_copy(update={"port": station.port}), memory)
    with pytest.raises(StationUnreachableError, match=r"station\.ocpp\.port"):
        await other.open()
    with pytest.raises(StationNotOpenError):
        await other.snapshot()
    await other.close()
