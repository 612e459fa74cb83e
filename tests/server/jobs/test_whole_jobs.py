"""Whole jobs, judged by what really happened in the simulated garage."""

from __future__ import annotations

import pytest

from drivers.station import PilotState
from server.control.model import PlugState
from server.jobs.model import JobPhase, JobState, JobType
from server.localisation.platform_places import BEYOND_MM
from server.schema.jobs import Job
from tests.support.garage import Scene, on_scene, shift_car
from twin.joints import TipPosition
from twin.kinematics import gamma

SLOWER_THAN_THE_LIMIT = 1.25


def _assert_well_plugged_in(scene: Scene, job: Job) -> None:
    assert job.error is None
    assert job.state is JobState.SUCCEEDED
    truth = scene.truth()
    assert truth.seated
    assert truth.lateral_error_mm < 0.5
    assert truth.insertion_depth_mm == pytest.approx(40.0, abs=1.0)
    assert 20.0 < truth.max_contact_force_n < 80.0
    assert truth.lateral_violation_mm == 0
    assert truth.load_breaks == 0
    assert scene.services.supervisor.plug.state is PlugState.INSERTED
    assert job.result.insertion_depth_mm == pytest.approx(truth.insertion_depth_mm, abs=0.5)


@pytest.mark.parametrize("seed", [0, 4])
def test_plugs_in_gently_precisely_and_almost_as_fast_as_the_joints_allow(seed: int) -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.carried_out(JobType.PLUG_IN)
        _assert_well_plugged_in(scene, job)
        result = job.result
        assert result.plugged_after_s is not None
        assert result.limit_duration_s is not None
        assert 1.0 < result.plugged_after_s / result.limit_duration_s <= SLOWER_THAN_THE_LIMIT
        assert "look" not in await scene.kinds(job)
        assert (await scene.station()).pilot is PilotState.B
        assert await scene.still()

    on_scene(scenario, seed=seed)


def test_looks_from_elsewhere_when_the_label_is_out_of_the_first_picture() -> None:
    async def scenario(scene: Scene) -> None:
        shift_car(scene.garage, x_mm=-85.0, y_mm=20.0)
        job = await scene.carried_out(JobType.PLUG_IN)
        _assert_well_plugged_in(scene, job)
        looks = [event.data["found"] for event in await scene.events(job) if event.kind == "look"]
        assert looks[-1:] == [True]  # two places are as near: either may come first

    on_scene(scenario, seed=1)


def test_finds_a_car_that_stands_just_outside_of_its_place() -> None:
    async def scenario(scene: Scene) -> None:
        geometry = scene.services.settings.geometry
        socket = TipPosition(*scene.garage.world.car.T_base_socket[:3, 3].tolist())
        box, now = geometry.regular_box, gamma.platform_for_tip(geometry, socket)[0]
        lowest_mm = box.center_y_mm - 0.5 * box.height_mm
        shift_car(
            scene.garage, x_mm=box.center_x_mm - now.x_mm, y_mm=lowest_mm - BEYOND_MM - now.y_mm
        )
        job = await scene.carried_out(JobType.PLUG_IN)
        _assert_well_plugged_in(scene, job)
        assert "look" in await scene.kinds(job)

    on_scene(scenario, seed=1)


def test_charges_its_energy_and_comes_back() -> None:
    async def scenario(scene: Scene) -> None:
        job = await scene.carried_out(JobType.CHARGE, energy_wh=50.0)
        assert job.error is None
        assert job.state is JobState.SUCCEEDED
        assert scene.seen == list(JobPhase)
        assert job.result.energy_wh == pytest.approx(50.0, abs=4.0)
        assert job.result.energy_wh is not None
        assert job.result.energy_wh >= 50.0
        truth, station = scene.truth(), await scene.station()
        assert truth.load_breaks == 0
        assert truth.lateral_violation_mm == 0
        assert not truth.locked
        assert scene.services.supervisor.plug.state is PlugState.PARKED
        assert scene.services.supervisor.holder is None
        assert station.pilot is PilotState.A
        assert not station.held
        assert not station.enabled

    on_scene(scenario, seed=2)


def test_charging_ends_when_somebody_finishes_it() -> None:
    async def scenario(scene: Scene) -> None:
        runner = scene.services.runner
        job = await scene.start(JobType.CHARGE)
        await scene.until_phase(JobPhase.CHARGING)
        await scene.until(lambda: scene.truth().locked)
        await runner.finish(job.id)
        ended = await scene.ended(job)
        assert ended.state is JobState.SUCCEEDED
        assert not ended.cancel_requested
        assert scene.services.supervisor.plug.state is PlugState.PARKED
        assert scene.truth().load_breaks == 0

    on_scene(scenario, seed=2)


def test_charging_ends_when_the_car_takes_no_more() -> None:
    async def scenario(scene: Scene) -> None:
        scene.garage.world.wanted_wh = 20.0
        job = await scene.carried_out(JobType.CHARGE)
        assert job.state is JobState.SUCCEEDED
        assert job.result.energy_wh == pytest.approx(20.0, abs=0.5)

    on_scene(scenario, seed=2)


def test_unplugs_what_was_plugged_in_and_needs_no_vehicle_for_it() -> None:
    async def scenario(scene: Scene) -> None:
        await scene.carried_out(JobType.PLUG_IN)
        vehicles = scene.services.vehicles
        [vehicle] = await vehicles.all()
        await vehicles.delete(vehicle.id)  # sold, with the plug in it
        job = await scene.carried_out(JobType.UNPLUG)
        assert job.error is None
        assert job.state is JobState.SUCCEEDED
        assert job.vehicle_id == vehicle.id
        assert scene.seen[-4:] == [
            JobPhase.PREFLIGHT,
            JobPhase.RELEASING,
            JobPhase.WITHDRAWING,
            JobPhase.PARKING,
        ]
        truth = scene.truth()
        assert truth.lateral_violation_mm == 0
        assert truth.load_breaks == 0
        assert scene.services.supervisor.plug.state is PlugState.PARKED
        assert not (await scene.station()).held

    on_scene(scenario, seed=4)
