"""What the charge point remembers over a restart, and what it does when nobody wants energy."""

from __future__ import annotations

from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st

from server.charge_point.counter import counted
from server.config.charge_point import ChargePointSettings
from server.config.settings import Settings
from server.control.model import PlugState
from server.jobs.model import JobPhase, JobType
from server.storage.charge_point import ChargePointRecord
from tests.support.garage import Scene, on_scene


def test_disabled_on_the_way_in_it_gets_no_energy_once_plugged() -> None:
    async def scenario(scene: Scene) -> None:
        charge_point = scene.services.charge_point
        await charge_point.set_enabled(enabled=True)
        await scene.until_phase(JobPhase.ALIGNING)
        await charge_point.set_enabled(enabled=False)
        await scene.until_phase(JobPhase.CHARGING)
        await scene.later(10.0)
        job = scene.services.runner.newest
        assert job is not None
        assert job.paused
        assert scene.truth().seated
        assert (await scene.station()).session_energy_wh < 5.0
        await charge_point.set_enabled(enabled=True)
        await scene.later(10.0)
        assert (await scene.station()).carries_load

    on_scene(scenario)


def test_disabled_for_long_the_car_is_unplugged_where_that_is_wanted() -> None:
    settings = Settings(charge_point=ChargePointSettings(unplug_after_disabled_min=1.0))

    async def scenario(scene: Scene) -> None:
        charge_point = scene.services.charge_point
        await charge_point.set_enabled(enabled=True)
        await scene.until_phase(JobPhase.CHARGING)
        await scene.later(5.0)
        await charge_point.set_enabled(enabled=False)
        await scene.later(50.0)
        assert scene.truth().seated
        await scene.services.runner.wait()
        assert scene.services.supervisor.plug.state is PlugState.PARKED
        view = charge_point.view()
        assert view.resting is None, "nobody has done that by hand"
        assert view.cp_state == "B"

    on_scene(scenario, settings=settings)


def test_energy_wish_and_rest_survive_a_restart(tmp_path: Path) -> None:
    async def first(scene: Scene) -> None:
        charge_point = scene.services.charge_point
        await charge_point.limit_current(16.0)
        scene.garage.world.wanted_wh = 30.0
        await charge_point.set_enabled(enabled=True)
        await scene.services.runner.wait()
        assert charge_point.view().resting == "charged"

    async def second(scene: Scene) -> None:
        view = scene.services.charge_point.view()
        assert (view.resting, view.enabled, view.max_current_a) == ("charged", False, 16.0)
        assert 0.028 < view.energy_kwh < 0.032
        before_kwh = view.energy_kwh
        scene.services.charge_point.resume()
        scene.garage.world.wanted_wh = 40.0
        await scene.carried_out(JobType.CHARGE)
        assert 0.038 < scene.services.charge_point.view().energy_kwh - before_kwh < 0.042

    on_scene(first, folder=tmp_path)
    on_scene(second, folder=tmp_path)


@given(st.lists(st.lists(st.floats(0, 5e4), max_size=5), max_size=6))
def test_the_counter_never_counts_backwards_and_forgets_no_session(
    sessions: list[list[float]],
) -> None:
    """Each session's counter rises; a new one begins at zero."""
    record, total_wh = ChargePointRecord(), 0.0
    for rises in sessions:
        session_wh = 0.0
        record = counted(record, 0.0)
        for rise in rises:
            session_wh += rise
            before = record.energy_wh
            record = counted(record, session_wh)
            assert record.energy_wh >= before
        total_wh += session_wh
    assert abs(record.energy_wh - total_wh) <= 1e-6 * max(total_wh, 1.0)
