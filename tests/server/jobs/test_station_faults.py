"""Stations that hang, lie, fail, or are switched on again by somebody else."""

from __future__ import annotations

import pytest

from drivers.simulator.station import SimulatedStation
from drivers.station import PilotState, StationCapabilities
from server.control.model import PlugState
from server.jobs.model import JobPhase, JobState, JobType
from server.schema.jobs import Job
from tests.support.garage import Scene, on_scene


def _code(job: Job) -> str:
    assert job.state is JobState.FAILED
    assert job.error is not None
    return job.error.code


async def _assert_still_plugged_in(scene: Scene) -> None:
    assert await scene.still()
    truth = scene.truth()
    assert truth.load_breaks == 0
    assert truth.lateral_violation_mm == 0
    assert scene.services.supervisor.plug.state is PlugState.INSERTED


def test_nothing_moves_while_the_station_is_out_of_order() -> None:
    async def scenario(scene: Scene) -> None:
        station = scene.garage.station
        station.hang()
        assert _code(await scene.carried_out(JobType.PLUG_IN)) == "station_unsafe"
        for lie in (
            {"pilot": PilotState.E},
            {"pilot": PilotState.F},
            {"pilot": PilotState.B},  # a car, although the plug is parked
            {"contactor_closed": True},
            {"currents_a": (0.0, 6.0, 0.0)},
        ):
            station.behave()
            station.lie(**lie)
            assert _code(await scene.carried_out(JobType.PLUG_IN)) == "station_unsafe"
        assert set(scene.seen) == {JobPhase.PREFLIGHT}
        station.behave()
        assert (await scene.carried_out(JobType.PLUG_IN)).error is None

    on_scene(scenario, seed=4)


def test_a_hold_left_behind_does_not_keep_the_next_car_from_charging() -> None:
    async def scenario(scene: Scene) -> None:
        await scene.garage.station.hold()
        job = await scene.carried_out(JobType.CHARGE, energy_wh=5.0)
        assert job.error is None

    on_scene(scenario, seed=4)


def test_a_plug_without_contact_comes_out_again() -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.INSERTING)
        scene.garage.station.lie(pilot=PilotState.A)
        assert _code(await scene.ended(job)) == "no_contact"
        assert scene.services.supervisor.plug.state is PlugState.PARKED

    on_scene(scenario, seed=4)


def test_one_lost_answer_does_not_undo_an_insertion() -> None:
    async def scenario(scene: Scene) -> None:
        station = scene.garage.station
        job = await scene.start(JobType.PLUG_IN)
        await scene.until_phase(JobPhase.INSERTING)
        await scene.until_moving()
        station.hang()
        await scene.later(0.5)
        station.behave()
        await scene.until_phase(JobPhase.PLUGGED)
        station.hang()
        await scene.later(1.0)
        station.behave()
        assert (await scene.ended(job)).error is None
        assert "insertion_waits" not in await scene.kinds(job)

    on_scene(scenario, seed=4)


def test_a_fault_while_charging_ends_the_job_with_the_plug_out() -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.start(JobType.CHARGE)
        await scene.until_phase(JobPhase.CHARGING)
        await scene.later(5.0)
        scene.garage.station.lie(pilot=PilotState.F)
        assert _code(await scene.ended(job)) == "station_unsafe"
        assert scene.services.supervisor.plug.state is PlugState.PARKED
        assert scene.truth().load_breaks == 0

    on_scene(scenario, seed=4)


def test_the_plug_stays_in_while_current_flows_or_nobody_knows() -> None:
    async def scenario(scene: Scene) -> None:
        station = scene.garage.station
        await scene.carried_out(JobType.PLUG_IN)
        await station.start()
        await scene.later(5.0)

        station.lie(currents_a=(16.0, 0.0, 0.0))
        job = await scene.carried_out(JobType.UNPLUG)
        assert _code(job) == "under_load"
        assert job.error is not None
        assert job.error.context["current_a"] == 16.0
        await _assert_still_plugged_in(scene)

        station.behave()
        station.freeze()
        assert _code(await scene.carried_out(JobType.UNPLUG)) == "station_unsafe"
        await _assert_still_plugged_in(scene)

        station.behave()
        station.hang()
        job = await scene.carried_out(JobType.UNPLUG)
        assert _code(job) == "station_unsafe"
        assert JobPhase.WITHDRAWING not in {event.phase for event in await scene.events(job)}
        await _assert_still_plugged_in(scene)

        station.behave()
        assert (await scene.carried_out(JobType.UNPLUG)).error is None
        assert scene.truth().load_breaks == 0

    on_scene(scenario, seed=4)


@pytest.mark.parametrize("blind", [False, True])
def test_a_station_that_falls_silent_stops_the_withdrawal(*, blind: bool) -> None:
    async def scenario(scene: Scene) -> None:
        await scene.carried_out(JobType.PLUG_IN)
        if blind:
            await scene.services.supervisor.plug.doubt()
        job = await scene.start(JobType.UNPLUG)
        await scene.until_phase(JobPhase.WITHDRAWING)
        await scene.until_moving()
        scene.garage.station.hang()
        assert _code(await scene.ended(job)) == "station_unsafe"
        await scene.later(0.5)
        assert await scene.still()
        truth = scene.truth()
        assert 0 < truth.insertion_depth_mm < 39.0
        assert truth.lateral_violation_mm == 0
        scene.garage.station.behave()
        assert (await scene.carried_out(JobType.UNPLUG)).error is None
        assert scene.truth().lateral_violation_mm == 0

    on_scene(scenario, seed=4)


def test_a_hold_outranks_a_hostile_energy_manager() -> None:
    async def scenario(scene: Scene) -> None:
        scene.garage.station.restart_by_itself(after_s=0.1)
        job = await scene.carried_out(JobType.CHARGE, energy_wh=5.0)
        assert job.error is None
        assert scene.truth().load_breaks == 0
        assert (await scene.station()).pilot is PilotState.A

    on_scene(scenario, seed=4)


def test_without_a_hold_power_that_comes_back_stops_the_withdrawal(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(
        SimulatedStation,
        "capabilities",
        StationCapabilities(switches=True, holds=False, unlocks=True),
    )

    async def scenario(scene: Scene) -> None:
        world = scene.garage.world
        monkeypatch.setattr(world, "lock_connector", lambda **_: None)  # a car without a lock
        await scene.carried_out(JobType.PLUG_IN)
        job = await scene.start(JobType.UNPLUG)
        await scene.until_phase(JobPhase.WITHDRAWING)
        await scene.garage.station.start()  # as an energy manager would
        assert _code(await scene.ended(job)) == "under_load"
        await _assert_still_plugged_in(scene)
        await scene.later(2.0)
        assert scene.truth().insertion_depth_mm > 30.0
        assert scene.truth().load_breaks == 0
        await scene.garage.station.stop()
        assert (await scene.carried_out(JobType.UNPLUG)).error is None

    on_scene(scenario, seed=4)


def test_without_a_hold_an_energy_manager_that_insists_keeps_the_plug_in(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(
        SimulatedStation,
        "capabilities",
        StationCapabilities(switches=True, holds=False, unlocks=True),
    )

    async def scenario(scene: Scene) -> None:
        await scene.carried_out(JobType.PLUG_IN)
        scene.garage.station.restart_by_itself(after_s=0.2)
        assert _code(await scene.carried_out(JobType.UNPLUG)) == "under_load"
        await _assert_still_plugged_in(scene)

    on_scene(scenario, seed=4)
