from __future__ import annotations

import asyncio
from typing import Any

import pytest

from drivers.station import (
    PilotState,
    StationAnswerError,
    StationHeldError,
    StationLoginError,
    StationStaleError,
    StationUnsupportedError,
)
from drivers.station.memory import StationMemory
from drivers.station.openevse import OpenevseStation
from drivers.station.settings import OpenevseSettings
from tests.support.eventually import eventually
from tests.support.fake_stations.openevse import FakeOpenevse
from tests.support.fake_stations.serving import serving

FOREIGN_LIMIT = {"type": "energy", "value": 12000, "auto_release": False}


async def test_it_reads_a_charging_car(
    openevse: OpenevseStation, fake_openevse: FakeOpenevse
) -> None:
    fake_openevse.plug(20.012)
    before_s = asyncio.get_running_loop().time()
    snapshot = await openevse.snapshot()
    assert snapshot.pilot is PilotState.C
    assert snapshot.contactor_closed
    assert snapshot.carries_load
    assert snapshot.currents_a == (30.0, 0.0, 0.0)
    assert (snapshot.power_w, snapshot.session_energy_wh) == (7200.0, 20.012)
    assert before_s <= snapshot.sampled_at_s <= asyncio.get_running_loop().time()


async def test_it_stops_and_starts(openevse: OpenevseStation, fake_openevse: FakeOpenevse) -> None:
    fake_openevse.plug(20.0)
    await openevse.stop()
    assert fake_openevse.override == {"state": "disabled", "auto_release": False}
    stopped = await openevse.snapshot()
    assert (stopped.pilot, stopped.enabled, stopped.carries_load) == (PilotState.B, False, False)
    await openevse.start()
    assert (await openevse.snapshot()).carries_load


async def test_a_hold_outranks_whoever_writes_the_override(
    openevse: OpenevseStation, fake_openevse: FakeOpenevse
) -> None:
    fake_openevse.plug(6.0)
    await openevse.stop()
    await openevse.hold()
    fake_openevse.override = {"state": "active", "auto_release": False}
    snapshot = await openevse.snapshot()
    assert snapshot.held
    assert not snapshot.enabled
    assert not snapshot.carries_load
    with pytest.raises(StationHeldError, match="release"):
        await openevse.start()


async def test_before_the_first_wh_an_override_helps_the_hold(
    openevse: OpenevseStation, fake_openevse: FakeOpenevse
) -> None:
    fake_openevse.plug(0.4)
    await openevse.hold()
    assert fake_openevse.override == {"state": "disabled", "auto_release": False}
    assert not (await openevse.snapshot()).carries_load
    # whoever starts it now gets 1 Wh and no more
    fake_openevse.override = None
    assert fake_openevse.charging
    fake_openevse.session_wh = 1.0
    assert not fake_openevse.charging


async def test_release_with_the_plug_out_leaves_no_trace(
    openevse: OpenevseStation, fake_openevse: FakeOpenevse
) -> None:
    fake_openevse.plug(6.0)
    await openevse.stop()
    await openevse.hold()
    fake_openevse.unplug()
    await openevse.release()
    assert (fake_openevse.override, fake_openevse.limit) == (None, None)
    assert not (await openevse.snapshot()).held


async def test_release_with_a_car_connected_gives_no_power(
    openevse: OpenevseStation, fake_openevse: FakeOpenevse
) -> None:
    fake_openevse.plug(6.0)
    await openevse.stop()
    await openevse.hold()
    await openevse.release()
    assert fake_openevse.limit is None
    assert fake_openevse.closed_after == []
    assert not (await openevse.snapshot()).enabled
    fake_openevse.unplug()
    assert fake_openevse.override is None, "the owner could not charge by hand"


async def test_a_limit_of_the_owner_comes_back_after_the_hold(
    openevse: OpenevseStation, fake_openevse: FakeOpenevse
) -> None:
    fake_openevse.plug(6.0)
    fake_openevse.limit = dict(FOREIGN_LIMIT)
    await openevse.hold()
    await openevse.hold()
    assert (await openevse.snapshot()).held
    await openevse.release()
    assert fake_openevse.limit == FOREIGN_LIMIT
    assert not (await openevse.snapshot()).held


async def test_it_has_no_lock(openevse: OpenevseStation) -> None:
    assert not openevse.capabilities.unlocks
    with pytest.raises(StationUnsupportedError, match="from the car"):
        await openevse.unlock()


@pytest.mark.parametrize(
    ("fields", "pilot", "loaded"),
    [
        ({"state": 2, "vehicle": 1}, PilotState.B, False),
        ({"state": 4}, PilotState.F, True),
        ({"state": 6}, PilotState.F, False),
        ({"state": 8}, PilotState.F, True),
        ({"state": 255, "vehicle": 1}, PilotState.B, False),
        ({"state": 254, "vehicle": 1, "amp": -4000}, PilotState.B, True),
    ],
)
async def test_each_state(
    openevse: OpenevseStation,
    fake_openevse: FakeOpenevse,
    fields: dict[str, Any],
    pilot: PilotState,
    loaded: bool,
) -> None:
    fake_openevse.fields = {"amp": 0, **fields}
    snapshot = await openevse.snapshot()
    assert (snapshot.pilot, snapshot.carries_load) == (pilot, loaded)


@pytest.mark.parametrize(
    "fields",
    [
        {"state": 0},
        {"state": "3"},
        {"state": None},
        {"amp": "0"},
        {"amp": float("1e300")},
        {"vehicle": 2},
        {"session_energy": -5},
        {"power": [0]},
    ],
)
async def test_nonsense_is_no_reading(
    openevse: OpenevseStation, fake_openevse: FakeOpenevse, fields: dict[str, Any]
) -> None:
    fake_openevse.fields = fields
    with pytest.raises(StationAnswerError, match="OpenEVSE"):
        await openevse.snapshot()


async def test_a_module_without_its_controller_knows_nothing(
    openevse: OpenevseStation, fake_openevse: FakeOpenevse
) -> None:
    fake_openevse.fields = {"evse_connected": 0}
    with pytest.raises(StationStaleError, match="cable"):
        await openevse.snapshot()


async def test_a_clock_that_was_set_is_none_the_worse_but_one_that_stands_is(
    openevse: OpenevseStation, fake_openevse: FakeOpenevse, monkeypatch: pytest.MonkeyPatch
) -> None:
    for time in ("2026-11-21T21:50:50Z", "1970-01-01T00:00:01Z", "2036-11-21T21:50:51Z"):
        fake_openevse.fields = {"time": time}
        snapshot = await openevse.snapshot()
        assert abs(snapshot.sampled_at_s - asyncio.get_running_loop().time()) < 60
    monkeypatch.setattr(openevse._clock, "_patience_s", 0.0)
    with pytest.raises(StationStaleError, match="same moment"):
        await openevse.snapshot()


async def test_a_push_shows_load_before_the_answer_does(
    openevse: OpenevseStation, fake_openevse: FakeOpenevse
) -> None:
    fake_openevse.plug(5.0)
    await openevse.stop()
    await eventually(openevse.push.connected.is_set)
    for message in ("<html>", "[]", '{"state":"x"}', '{"amp":120}', '{"state":254}'):
        await fake_openevse.push(message)
    seen_s = openevse.push.load_seen_s
    await fake_openevse.push('{"amp":16000}')
    await eventually(lambda: openevse.push.load_seen_s > seen_s)
    # it arrives after a reading was asked for and before its answer
    openevse.push.load_seen_s += 3600.0
    assert (await openevse.snapshot()).carries_load


async def test_a_password_is_used_and_never_told(memory: StationMemory) -> None:
    fake = FakeOpenevse(password="correct horse")  # noqa: S106 - of the fake
    async with serving(fake.app) as url:
        for password, works in (("correct horse", True), ("wrong donkey", False)):
            settings = OpenevseSettings.model_validate(
                {"url": url, "password": password, "push": False}
            )
            assert password not in repr(settings)
            station = OpenevseStation(settings, memory)
            if works:
                await station.open()
            else:
                with pytest.raises(StationLoginError, match="password") as error:
                    await station.open()
                assert password not in str(error.value)
            await station.close()
