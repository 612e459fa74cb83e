from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import pytest

from drivers.station import (
    PilotState,
    StationAnswerError,
    StationHeldError,
    StationMemoryError,
    StationRefusedError,
)
from drivers.station.evcc import EvccStation
from drivers.station.memory import StationMemory
from drivers.station.settings import EvccSettings
from tests.support.fake_stations.evcc import FakeEvcc


async def test_what_it_says_is_as_old_as_its_interval(
    evcc: EvccStation, fake_evcc: FakeEvcc
) -> None:
    fake_evcc.point |= {"charging": True, "chargePower": 11040, "sessionEnergy": 18.393}
    snapshot = await evcc.snapshot()
    assert snapshot.pilot is PilotState.C
    assert snapshot.carries_load
    assert snapshot.currents_a[0] == pytest.approx(48.0)
    assert snapshot.session_energy_wh == 18.393
    assert asyncio.get_running_loop().time() - snapshot.sampled_at_s >= 30.0
    assert not evcc.capabilities.fresh


@pytest.mark.parametrize("mode", ["now", "pv", "minpv", "off"])
async def test_the_mode_before_the_hold_comes_back(
    evcc: EvccStation, fake_evcc: FakeEvcc, mode: str
) -> None:
    fake_evcc.mode = mode
    await evcc.stop()
    await evcc.hold()
    snapshot = await evcc.snapshot()
    assert (fake_evcc.mode, snapshot.held, snapshot.enabled) == ("off", True, False)
    with pytest.raises(StationHeldError):
        await evcc.start()
    await evcc.release()
    assert fake_evcc.mode == mode
    assert not (await evcc.snapshot()).held


async def test_the_mode_survives_the_end_of_the_process(
    evcc_url: str, fake_evcc: FakeEvcc, tmp_path: Path
) -> None:
    settings = EvccSettings(url=evcc_url, loadpoint=2)
    file = tmp_path / "data" / "station.json"
    fake_evcc.mode = "minpv"
    before = EvccStation(settings, StationMemory(file))
    await before.open()
    await before.hold()
    await before.close()
    after = EvccStation(settings, StationMemory(file))
    await after.open()
    assert (await after.snapshot()).held
    await after.release()
    await after.close()
    assert fake_evcc.mode == "minpv"
    assert await StationMemory(file).get(after._memory_name) is None


async def test_a_mode_that_cannot_be_written_down_is_not_lost(
    evcc_url: str, fake_evcc: FakeEvcc, tmp_path: Path
) -> None:
    (tmp_path / "file").write_text("in the way of a folder")
    fake_evcc.mode = "pv"
    evcc = EvccStation(
        EvccSettings(url=evcc_url, loadpoint=2), StationMemory(tmp_path / "file" / "station.json")
    )
    await evcc.open()
    with pytest.raises(StationMemoryError, match=r"written|read"):
        await evcc.hold()
    await evcc.close()
    assert fake_evcc.mode == "pv"


@pytest.mark.parametrize("content", ["{", "[]", '{"a": 1}'])
async def test_a_spoilt_file_is_told_and_kept(tmp_path: Path, content: str) -> None:
    file = tmp_path / "station.json"
    file.write_text(content)
    with pytest.raises(StationMemoryError, match="delete the file"):
        await StationMemory(file).get("anything")
    assert file.read_text() == content


async def test_a_mode_that_somebody_chose_meanwhile_stays(
    evcc: EvccStation, fake_evcc: FakeEvcc
) -> None:
    fake_evcc.mode = "pv"
    await evcc.hold()
    fake_evcc.mode = "now"
    snapshot = await evcc.snapshot()
    assert snapshot.enabled
    assert not snapshot.held
    await evcc.release()
    assert fake_evcc.modes == ["off"]


async def test_start_continues_what_was_stopped(evcc: EvccStation, fake_evcc: FakeEvcc) -> None:
    await evcc.start()
    assert fake_evcc.mode == "now"
    fake_evcc.mode = "pv"
    await evcc.start()
    assert fake_evcc.mode == "pv"
    await evcc.stop()
    await evcc.start()
    assert fake_evcc.mode == "pv"


async def test_a_load_point_that_is_not_there(evcc_url: str, memory: StationMemory) -> None:
    evcc = EvccStation(EvccSettings(url=evcc_url, loadpoint=9), memory)
    with pytest.raises(StationAnswerError, match="2 load points"):
        await evcc.open()
    await evcc.close()


async def test_a_mode_that_evcc_refuses(evcc: EvccStation) -> None:
    with pytest.raises(StationRefusedError, match="invalid value"):
        await evcc._set_mode("bogus")  # type: ignore[arg-type]  # what a newer evcc may say


@pytest.mark.parametrize(
    "lie",
    [
        {"charging": "false"},
        {"connected": None},
        {"chargePower": "0"},
        {"chargeCurrents": [0, 0]},
        {"mode": "turbo"},
    ],
)
async def test_nonsense_is_no_reading(
    evcc: EvccStation, fake_evcc: FakeEvcc, lie: dict[str, Any]
) -> None:
    fake_evcc.point |= lie
    with pytest.raises(StationAnswerError, match="loadpoints"):
        await evcc.snapshot()
