from __future__ import annotations

from collections.abc import AsyncIterator
from typing import Any

import pytest

from drivers.station import (
    PilotState,
    StationAnswerError,
    StationHeldError,
    StationRefusedError,
    StationStaleError,
    StationUnsupportedError,
)
from drivers.station.evcc import EvccStation
from drivers.station.goe import GoeStation
from drivers.station.managed import ManagedStation
from drivers.station.memory import StationMemory
from drivers.station.settings import GoeSettings
from tests.support.fake_stations.evcc import FakeEvcc
from tests.support.fake_stations.goe import FakeGoe
from tests.support.fake_stations.serving import serving


@pytest.fixture
def fake() -> FakeGoe:
    return FakeGoe()


@pytest.fixture
async def goe(fake: FakeGoe, memory: StationMemory) -> AsyncIterator[GoeStation]:
    async with serving(fake.app) as url:
        station = GoeStation(GoeSettings(url=url, timeout_s=3.0), memory)
        await station.open()
        yield station
        await station.close()


async def test_it_reads_switches_and_reads_again(goe: GoeStation, fake: FakeGoe) -> None:
    assert (await goe.snapshot()).pilot is PilotState.A
    fake.plug()
    charging = await goe.snapshot()
    assert charging.pilot is PilotState.C
    assert charging.currents_a == (15.9, 15.9, 0.0)
    assert charging.power_w == pytest.approx(7329.9)
    assert (charging.session_energy_wh, charging.connector_locked) == (812.5, True)
    await goe.stop()
    stopped = await goe.snapshot()
    assert (stopped.pilot, stopped.enabled, stopped.carries_load) == (PilotState.B, False, False)
    assert not stopped.held
    await goe.start()
    assert (await goe.snapshot()).carries_load


async def test_it_claims_no_hold_that_outranks_others(goe: GoeStation, fake: FakeGoe) -> None:
    assert not goe.capabilities.holds
    fake.plug()
    await goe.hold()
    assert (await goe.snapshot()).held
    with pytest.raises(StationHeldError):
        await goe.start()
    fake.force(2)
    undone = await goe.snapshot()
    assert undone.carries_load
    assert not undone.held


async def test_release_gives_no_power_to_a_connected_car(goe: GoeStation, fake: FakeGoe) -> None:
    fake.plug()
    await goe.hold()
    await goe.release()
    assert fake.frc == 1
    await goe.hold()
    fake.unplug()
    await goe.release()
    assert fake.frc == 0


@pytest.mark.parametrize(
    ("fields", "pilot", "loaded"),
    [
        ({"car": 0}, PilotState.F, False),
        ({"car": 3}, PilotState.B, False),
        ({"car": 4}, PilotState.B, False),
        ({"car": 5, "err": 3}, PilotState.F, False),
        ({"car": 1, "err": 9}, PilotState.F, True),
        ({"car": 3, "nrg": [230] * 4 + [0, -6.0, 0] + [0] * 9}, PilotState.B, True),
    ],
)
async def test_each_state(
    goe: GoeStation, fake: FakeGoe, fields: dict[str, Any], pilot: PilotState, loaded: bool
) -> None:
    fake.fields = fields
    snapshot = await goe.snapshot()
    assert (snapshot.pilot, snapshot.carries_load) == (pilot, loaded)


@pytest.mark.parametrize(
    "fields", [{"car": None}, {"car": 7}, {"nrg": [0] * 7}, {"alw": "no"}, {"frc": True}]
)
async def test_nonsense_is_no_reading(
    goe: GoeStation, fake: FakeGoe, fields: dict[str, Any]
) -> None:
    fake.fields = fields
    with pytest.raises(StationAnswerError):
        await goe.snapshot()


async def test_an_answer_that_is_repeated_is_stale(
    goe: GoeStation, fake: FakeGoe, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(goe._clock, "_patience_s", 0.0)
    await goe.snapshot()
    fake.uptime_ms = 5  # it was restarted: no reason to worry
    await goe.snapshot()
    fake.clock_stands = True
    with pytest.raises(StationStaleError, match="same moment"):
        await goe.snapshot()


async def test_a_refusal_is_told(goe: GoeStation, fake: FakeGoe) -> None:
    fake.refuses = True
    with pytest.raises(StationRefusedError, match="local API"):
        await goe.stop()
    with pytest.raises(StationUnsupportedError):
        await goe.unlock()


async def test_behind_evcc_it_can_be_held(
    goe: GoeStation, fake: FakeGoe, evcc: EvccStation, fake_evcc: FakeEvcc
) -> None:
    managed = ManagedStation(evcc, goe)
    assert managed.capabilities.holds
    fake_evcc.mode = "pv"
    fake.plug()
    await managed.stop()
    assert not (await managed.snapshot()).held
    await managed.hold()
    held = await managed.snapshot()
    assert (held.held, held.enabled, held.carries_load) == (True, False, False)
    fake.unplug()
    await managed.release()
    assert (fake.frc, fake_evcc.mode) == (0, "pv")
