"""The routine on badly built robots: what it finds, and what it notices."""

from __future__ import annotations

import httpx
import numpy as np
import pytest

from server.calibration.grade import Grade
from server.calibration.routines import robot_routine, stand
from server.calibration.routines.errors import NoRoutineError, RoutineRunningError
from server.config.settings import Settings
from server.control.errors import ControlBusyError
from server.jobs.model import JobType
from server.schema.routines import RobotRoutineRequest, Routine
from server.schema.vehicles import VehicleSettings
from server.simulated_calibration import before_calibration, tip_errors_mm
from server.simulated_technician import SimulatedTechnician
from tests.support.api import on_api, problem
from tests.support.garage import Scene, on_scene, shift_car


def badly_built(*, play_mm: float = 0.05) -> Settings:
    settings = Settings()
    parameters = settings.simulation.parameters
    drives = parameters.drives.model_copy(update={"backlash_mm": (play_mm,) * 3})
    build = before_calibration(parameters.build).model_copy(update={"focal_std_fraction": 0.01})
    parameters = parameters.model_copy(update={"build": build, "drives": drives})
    simulation = settings.simulation.model_copy(update={"parameters": parameters})
    return settings.model_copy(update={"simulation": simulation})


def shown(scene: Scene) -> Routine:
    routine = scene.services.routines.shown
    assert routine is not None
    return routine


async def begin(scene: Scene) -> None:
    await scene.services.routines.begin(RobotRoutineRequest(), "Anna")


async def until_done(scene: Scene, looks: int) -> None:
    await scene.until(lambda: shown(scene).done >= looks or shown(scene).state != "running")


@pytest.fixture
def short(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ten poses and one picture of each: enough to notice what goes wrong."""
    monkeypatch.setattr(robot_routine, "POSES", 10)
    monkeypatch.setattr(robot_routine, "FEWEST_LOOKS", 8)
    monkeypatch.setattr(stand, "FRAMES", 1)


@pytest.mark.parametrize(("seed", "play_mm"), [(5, 0.05), (8, 0.3)])
def test_a_badly_built_robot_becomes_accurate(seed: int, play_mm: float) -> None:
    """Even with a focal length that is 1 % off, once the board was photographed, and with play."""

    async def scenario(scene: Scene) -> None:
        services, world = scene.services, scene.garage.world
        supervisor, geometry = services.supervisor, services.settings.geometry
        technician = SimulatedTechnician(services, world, np.random.default_rng(seed))
        lens = technician.camera_calibration(scene.garage.camera.optics, "Anna")
        kept = await services.calibrations.keep(lens)
        await services.calibrations.activate(kept.id, by="Anna", accept_worse=False)
        drawn_px = services.settings.camera.optics.fx
        assert abs(scene.garage.camera.optics.fx / drawn_px - 1) > 0.004
        await services.routines.begin(technician.request(), "Anna")
        with pytest.raises(RoutineRunningError):
            await begin(scene)
        with pytest.raises(ControlBusyError):
            await scene.start(JobType.PLUG_IN)
        await services.routines.wait()
        routine = shown(scene)
        assert routine.problem is None
        assert routine.state == "finished"
        assert routine.done == routine.total == 25
        assert all(look.seen for look in routine.looks), "none is lost at the edge or to the plug"
        assert supervisor.built.correction is None, "nobody uses it yet"
        assert supervisor.holder is None
        assert routine.calibration_id is not None
        found = await services.calibrations.get(routine.calibration_id)
        assert (found.made_by, found.grade) == ("Anna", Grade.GOOD)
        assert found.evidence is not None
        assert found.evidence.duration_s < 180
        assert found.error is not None
        assert found.error_in_use is not None
        assert found.error < 0.03 < found.error_in_use
        assert found.evidence.tip_at_most_mm is not None
        assert found.evidence.tip_at_most_mm < 0.2
        assert any("belt" in sentence for sentence in found.evidence.unseen)
        before = tip_errors_mm(world, geometry, supervisor.built)
        await services.calibrations.activate(found.id, by="Anna", accept_worse=False)
        after = tip_errors_mm(world, geometry, supervisor.built)
        assert np.percentile(after, 95) < min(0.12, found.evidence.tip_at_most_mm)
        assert np.percentile(before, 95) > 4 * np.percentile(after, 95)

    on_scene(scenario, seed=seed, settings=badly_built(play_mm=play_mm))


@pytest.mark.usefixtures("short")
def test_a_label_lost_at_the_wiring_costs_a_place_and_no_pose_more() -> None:
    async def scenario(scene: Scene) -> None:
        await begin(scene)
        await scene.services.routines.wait()
        routine = shown(scene)
        assert routine.state == "finished"
        assert [look.seen for look in routine.looks] == [True, True, False, *(True,) * 7]
        assert routine.done == routine.total == 10

    on_scene(scenario, seed=35, settings=badly_built(play_mm=0.3))


@pytest.mark.usefixtures("short")
def test_poses_used_up_without_the_label_are_counted_anew() -> None:
    async def scenario(scene: Scene) -> None:
        await begin(scene)
        await until_done(scene, 6)
        scene.garage.world.hide_label()
        await scene.services.routines.wait()
        assert (shown(scene).state, shown(scene).done) == ("interrupted", 10)
        scene.garage.world.show_label()
        await scene.services.routines.resume()
        await scene.services.routines.wait()
        assert (shown(scene).state, shown(scene).done) == ("finished", 10)
        assert len(shown(scene).looks) == 10

    on_scene(scenario, seed=2)


@pytest.mark.usefixtures("short")
def test_a_label_that_moves_is_noticed_and_nothing_is_kept() -> None:
    async def scenario(scene: Scene) -> None:
        await begin(scene)
        await until_done(scene, 5)
        shift_car(scene.garage, x_mm=1.0)
        await scene.services.routines.wait()
        routine = shown(scene)
        assert routine.state == "failed"
        assert routine.problem is not None
        assert routine.problem.code == "calibration_label_moved"
        assert routine.problem.context["moved_mm"] == pytest.approx(1.0, abs=0.1)
        assert routine.calibration_id is None
        assert not await scene.services.calibrations.page(kind=None, before=None, limit=5)
        with pytest.raises(NoRoutineError):
            await scene.services.routines.resume()

    on_scene(scenario, seed=2)


@pytest.mark.usefixtures("short")
def test_a_stop_interrupts_it_and_what_was_seen_is_kept_for_going_on() -> None:
    async def scenario(scene: Scene) -> None:
        services = scene.services
        await begin(scene)
        await until_done(scene, 5)
        await services.supervisor.stop()
        await services.routines.wait()
        routine = shown(scene)
        assert routine.state == "interrupted"
        assert routine.problem is not None
        assert routine.problem.code == "stopped"
        assert services.supervisor.holder is None
        await services.supervisor.reset()
        await services.routines.resume()
        assert shown(scene).done == routine.done, "nothing is done twice"
        await services.routines.wait()
        assert shown(scene).state == "finished"
        # the label was compared once more, and one of the places that were left is given up for it
        assert shown(scene).done == shown(scene).total == 10

    on_scene(scenario, seed=2)


@pytest.mark.usefixtures("short")
def test_a_label_that_moves_while_the_routine_waits_is_noticed_first() -> None:
    async def scenario(scene: Scene) -> None:
        services = scene.services
        await begin(scene)
        await until_done(scene, 5)
        await services.supervisor.stop()
        await services.routines.wait()
        before = shown(scene).done
        shift_car(scene.garage, y_mm=-0.6)
        await services.supervisor.reset()
        await services.routines.resume()
        await services.routines.wait()
        routine = shown(scene)
        assert routine.state == "failed"
        assert routine.problem is not None
        assert routine.problem.code == "calibration_label_moved"
        assert routine.done == before + 1

    on_scene(scenario, seed=2)


@pytest.mark.usefixtures("short")
def test_a_hidden_label_is_waited_for() -> None:
    async def scenario(scene: Scene) -> None:
        services = scene.services
        await begin(scene)
        await until_done(scene, 6)
        scene.garage.world.hide_label()
        await services.routines.wait()
        routine = shown(scene)
        assert routine.state == "interrupted"
        assert routine.problem is not None
        assert routine.problem.code == "calibration_label_lost"
        assert not routine.looks[-1].seen

    on_scene(scenario, seed=2)


@pytest.mark.usefixtures("short")
def test_another_cars_label_is_named() -> None:
    async def scenario(scene: Scene) -> None:
        services = scene.services
        zoe = VehicleSettings(name="Zoe")
        await services.vehicles.put("zoe", zoe)
        await services.routines.begin(RobotRoutineRequest(vehicle_id="zoe"), "Anna")
        await services.routines.wait()
        routine = shown(scene)
        assert routine.state == "interrupted"
        assert routine.problem is not None
        assert "Zoe" in routine.problem.detail
        assert "PP2:demo" in routine.problem.detail

    on_scene(scenario, seed=2)


def test_cancelling_brings_the_robot_to_rest_and_keeps_nothing() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        problem(await client.post("calibrations/routine/cancel"), 409, "calibration_none")
        unknown = await client.post(
            "calibrations/routine", json={"kind": "robot", "vehicle_id": "nobody"}
        )
        problem(unknown, 404, "unknown_vehicle")
        begun = await client.post("calibrations/routine", json={"kind": "robot"})
        assert begun.status_code == 202
        assert begun.json()["state"] == "running"
        await until_done(scene, 4)
        await scene.until_moving()
        ended = await client.post("calibrations/routine/cancel")
        assert ended.json()["state"] == "cancelled"
        assert scene.services.supervisor.holder is None
        assert await scene.still()
        now = (await client.get("calibrations/now")).json()
        assert now["routine"]["looks"]
        assert now["routine"]["calibration_id"] is None

    on_api(scenario, parked=True)


def test_what_breaks_down_is_told_and_lets_go_of_the_robot(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    async def scenario(scene: Scene) -> None:
        def broken(*_: object, **__: object) -> None:
            raise ZeroDivisionError

        monkeypatch.setattr(robot_routine, "next_places", broken)
        await begin(scene)
        await scene.services.routines.wait()
        assert shown(scene).state == "failed"
        assert shown(scene).problem is not None
        assert scene.services.supervisor.holder is None

    on_scene(scenario, seed=2)
