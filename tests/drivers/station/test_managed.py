from __future__ import annotations

import pytest

from drivers.station import (
    PilotState,
    StationDriver,
    StationHeldError,
    StationSilentError,
    StationSnapshot,
    StationUnreachableError,
)
from drivers.station.evcc import EvccStation
from drivers.station.managed import ManagedStation
from drivers.station.openevse import OpenevseStation
from server.control.errors import ControlError, StationUnsafeError, StillUnderLoadError
from server.control.load_rule import why_not_safe
from tests.support.fake_stations.evcc import FakeEvcc
from tests.support.fake_stations.openevse import FakeOpenevse


@pytest.fixture
def managed(evcc: EvccStation, openevse: OpenevseStation) -> ManagedStation:
    return ManagedStation(evcc, openevse, lets_go_s=0.3)


@pytest.fixture
def charging(fake_evcc: FakeEvcc, fake_openevse: FakeOpenevse) -> None:
    fake_openevse.plug(500.0)
    fake_evcc.mode = "now"
    fake_evcc.tick()
    fake_evcc.tick()
    assert fake_openevse.charging


@pytest.mark.usefixtures("charging")
async def test_a_station_stopped_behind_the_managers_back_starts_again(
    openevse: OpenevseStation, fake_evcc: FakeEvcc, fake_openevse: FakeOpenevse
) -> None:
    await openevse.stop()
    assert not (await openevse.snapshot()).carries_load
    fake_evcc.tick()
    assert fake_openevse.charging, "the fake does not show the hazard"
    assert fake_evcc.point["chargePower"] == 0, "evcc should still believe in zero"


@pytest.mark.usefixtures("charging")
async def test_the_whole_way_of_an_unplug(
    managed: ManagedStation, fake_evcc: FakeEvcc, fake_openevse: FakeOpenevse
) -> None:
    await managed.stop()
    await managed.hold()
    assert "POST /limit" in fake_openevse.requests
    assert fake_evcc.modes == ["off"]
    for _ in range(3):
        fake_evcc.tick()
        snapshot = await managed.snapshot()
        assert not snapshot.carries_load
        assert not snapshot.enabled
        assert snapshot.held
    # even the command of a cycle that was under way does not get through
    fake_openevse.override = {"state": "active", "auto_release": True}
    assert not (await managed.snapshot()).carries_load
    assert fake_openevse.closed_after == []
    fake_openevse.unplug()
    await managed.release()
    assert fake_evcc.mode == "now"
    assert fake_openevse.limit is None
    assert not (await managed.snapshot()).held


@pytest.mark.usefixtures("charging")
async def test_the_manager_is_off_before_the_station_is_held_and_back_after_it(
    managed: ManagedStation, fake_evcc: FakeEvcc, fake_openevse: FakeOpenevse
) -> None:
    seen: list[str] = []
    station_hold = managed._station.hold

    async def hold_station() -> None:
        seen.append(f"station held with evcc {fake_evcc.mode}")
        await station_hold()

    managed._station.hold = hold_station  # type: ignore[method-assign]  # only listens
    station_release = managed._station.release

    async def release_station() -> None:
        await station_release()
        seen.append(f"station released with evcc {fake_evcc.mode}")

    managed._station.release = release_station  # type: ignore[method-assign]  # only listens
    await managed.hold()
    fake_openevse.unplug()
    await managed.release()
    assert seen == ["station held with evcc off", "station released with evcc off"]
    assert fake_evcc.mode == "now"


@pytest.mark.usefixtures("charging")
async def test_a_manager_that_does_not_let_go_is_told(
    managed: ManagedStation, fake_evcc: FakeEvcc, fake_openevse: FakeOpenevse
) -> None:
    fake_evcc.sticky = True
    with pytest.raises(StationSilentError, match="Switch it off in its own page"):
        await managed.hold()
    assert fake_openevse.limit is None


@pytest.mark.usefixtures("charging")
async def test_somebody_who_switches_the_manager_on_again_shows_at_once(
    managed: ManagedStation, fake_evcc: FakeEvcc
) -> None:
    await managed.hold()
    fake_evcc.mode = "now"
    assert (await managed.snapshot()).enabled


@pytest.mark.usefixtures("charging")
async def test_a_manager_that_is_gone_makes_everything_unknown(
    managed: ManagedStation, evcc: EvccStation, openevse: OpenevseStation
) -> None:
    await managed.hold()
    assert (await managed.snapshot()).pilot is PilotState.B
    evcc._web.url = "http://127.0.0.1:9"
    await evcc.close()
    evcc._web.open()
    with pytest.raises(StationUnreachableError, match="address"):
        await managed.snapshot()
    assert (await openevse.snapshot()).held


@pytest.mark.usefixtures("charging")
async def test_start_waits_for_the_release_and_leaves_the_decision_to_the_manager(
    managed: ManagedStation, fake_evcc: FakeEvcc, fake_openevse: FakeOpenevse
) -> None:
    await managed.hold()
    with pytest.raises(StationHeldError):
        await managed.start()
    await managed.release()
    await managed.stop()
    fake_openevse.unplug()
    fake_openevse.plug()
    await managed.start()
    fake_evcc.tick()
    assert fake_evcc.mode == "now"
    assert (await managed.snapshot()).carries_load


@pytest.mark.usefixtures("charging")
async def test_a_job_believes_the_station_and_never_evcc_alone(
    managed: ManagedStation, evcc: EvccStation, openevse: OpenevseStation
) -> None:
    def against(station: StationDriver, snapshot: StationSnapshot) -> type[ControlError] | None:
        # judged at the time of the reading of the station, however busy this machine is
        now_s = snapshot.sampled_at_s
        problem = why_not_safe(snapshot, station.capabilities, now_s, age_limit_s=1.0)
        return None if problem is None else type(problem)

    assert against(managed, await managed.snapshot()) is StillUnderLoadError
    await openevse.stop()
    assert against(openevse, await openevse.snapshot()) is None
    assert against(managed, await managed.snapshot()) is StillUnderLoadError, "evcc is still on"
    await managed.hold()
    assert against(managed, await managed.snapshot()) is None
    assert against(evcc, await evcc.snapshot()) is StationUnsafeError
