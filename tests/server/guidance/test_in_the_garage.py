"""Cars that park in the simulated garage, seen through the simulated camera."""

from __future__ import annotations

import math

import numpy as np
import pytest

from drivers.camera import pi_camera_v2
from drivers.simulator.camera.imaging import CameraFault
from drivers.simulator.parameters import SimulationParameters
from server.config.camera import CameraSettings
from server.config.guidance import GuidanceSettings
from server.config.settings import Settings
from server.control.model import PlugState
from server.guidance.model import GuidanceState, PauseReason
from server.guidance.words import PAUSED
from server.jobs.model import JobState, JobType
from tests.server.guidance.parking import Parking
from tests.support.garage import Scene, on_scene, shift_car

MOVE, STOP, GOOD = GuidanceState.MOVE, GuidanceState.STOP, GuidanceState.GOOD


def park_in_the_middle(scene: Scene, **shift: float) -> None:
    """Let the car's place be the middle of what the robot serves."""
    guide = scene.services.guide
    x, y, z = scene.garage.world.spot.place[:3, 3]
    box = scene.services.settings.geometry.regular_box
    shift_car(
        scene.garage,
        x_mm=box.center_x_mm - x + shift.get("x_mm", 0.0),
        y_mm=guide.reach.middle_y_mm - y + shift.get("y_mm", 0.0),
        z_mm=guide.reach.stop_z_mm - z + shift.get("z_mm", 0.0),
        yaw_rad=shift.get("yaw_rad", 0.0),
    )


def quick(**label_condition: float) -> Settings:
    """Fewer and smaller pictures, to be drawn quickly, and a label in some condition."""
    parameters = SimulationParameters()
    label = parameters.conditions.label.model_copy(update=label_condition)
    conditions = parameters.conditions.model_copy(update={"label": label})
    full = pi_camera_v2()
    half = full.model_copy(
        update={
            "width": full.width // 2,
            "height": full.height // 2,
            "fx": full.fx / 2,
            "fy": full.fy / 2,
            "cx": (full.width / 2 - 1) / 2,
            "cy": (full.height / 2 - 1) / 2,
        }
    )
    settings = Settings(
        camera=CameraSettings(optics=half),
        guidance=GuidanceSettings(tracking_period_s=0.2, search_period_s=0.4),
    )
    simulation = settings.simulation.model_copy(
        update={"parameters": parameters.model_copy(update={"conditions": conditions})}
    )
    return settings.model_copy(update={"simulation": simulation})


def test_a_driver_who_does_as_told_stands_well_and_the_robot_plugs_in() -> None:
    async def scenario(scene: Scene) -> None:
        park_in_the_middle(scene)
        parking = Parking(scene)
        parking.arrive(from_mm=1300.0, right_mm=20.0, past_mm=30.0)
        advice = await parking.obey()
        assert advice.state is GOOD, parking.said
        assert parking.states[:3] == [GuidanceState.SEARCHING, MOVE, STOP]
        numbers = [words for state, words in parking.said if state is MOVE]
        assert any(words.endswith("cm forward") for words in numbers)
        car = parking.guide.now.car
        assert car is not None
        error = car.place_mm - scene.truth().T_base_socket[:3, 3]
        # as exact as the robot is built; it sags by a millimetre
        assert np.all(np.abs(error) < (1.0, 2.0, 1.0))
        assert parking.arriving()
        job = await scene.carried_out(JobType.PLUG_IN)
        assert job.state is JobState.SUCCEEDED, job.error

    on_scene(scenario, seed=2, settings=quick())


def test_who_stops_short_is_told_how_far() -> None:
    async def scenario(scene: Scene) -> None:
        park_in_the_middle(scene)
        parking = Parking(scene)
        parking.arrive(from_mm=600.0, past_mm=-70.0)
        await parking.watch(9.0)
        advice = parking.advice
        truth_mm = scene.truth().T_base_socket[2, 3] - parking.guide.reach.stop_z_mm
        assert advice.state is MOVE
        assert advice.steps[0].distance_mm == pytest.approx(truth_mm, abs=1.5)
        assert advice.words.headline == f"{round(truth_mm / 10)} cm forward"
        parking.traffic.creep(truth_mm, scene.now_s)
        await parking.watch(6.0)
        assert parking.advice.state is GOOD

    on_scene(scenario, seed=3, settings=quick())


def test_a_car_that_comes_in_askew_is_told_so_with_its_side() -> None:
    async def scenario(scene: Scene) -> None:
        park_in_the_middle(scene, yaw_rad=math.radians(-6.0))
        parking = Parking(scene)
        parking.arrive(from_mm=700.0)
        advice = await parking.until(GuidanceState.SKEWED)
        tilt = scene.truth().T_base_socket[:3, 2] @ scene.services.settings.geometry.insertion_axis
        true_deg = math.degrees(math.acos(tilt))
        car = parking.guide.now.car
        assert car is not None
        assert math.degrees(car.skew_rad) == pytest.approx(true_deg, abs=0.5)
        to_the_right = -scene.truth().T_base_socket[0, 2] > 0
        assert advice.words.remedy.endswith("right." if to_the_right else "left.")

    on_scene(scenario, seed=3, settings=quick())


@pytest.mark.parametrize(("beside_mm", "side"), [(-125.0, "right"), (150.0, "left")])
def test_a_car_beside_its_place_is_told_which_side(beside_mm: float, side: str) -> None:
    async def scenario(scene: Scene) -> None:
        park_in_the_middle(scene, x_mm=beside_mm)
        parking = Parking(scene)
        parking.arrive(from_mm=500.0, past_mm=-150.0)
        await parking.watch(12.0)
        advice = parking.advice
        assert advice.state is MOVE
        aside = next(step for step in advice.steps if step.direction.value == side)
        socket = scene.truth().T_base_socket[:3, 3]
        zone = parking.guide.reach.good
        rail = zone.rail_at(zone.upward.middle_mm)
        edge_mm = rail.low_mm if side == "right" else rail.high_mm
        assert aside.distance_mm == pytest.approx(abs(edge_mm - socket[0]), abs=5.0)

    on_scene(scenario, seed=3, settings=quick())


def test_a_dirty_label_is_named_as_soon_as_it_should_be_readable() -> None:
    async def scenario(scene: Scene) -> None:
        park_in_the_middle(scene)
        parking = Parking(scene)
        parking.arrive(from_mm=600.0)
        await parking.until(GuidanceState.UNREADABLE)
        await parking.watch(5.0)  # from afar it might only be too small
        assert parking.advice.words.headline == "The label cannot be read"
        assert "wipe the label" in parking.advice.words.remedy

    on_scene(scenario, seed=3, settings=quick(covered=0.15))


def test_a_label_that_is_covered_on_the_way_stops_the_driver() -> None:
    async def scenario(scene: Scene) -> None:
        park_in_the_middle(scene)
        parking = Parking(scene)
        parking.arrive(from_mm=1000.0)
        await parking.until(MOVE)
        scene.garage.world.hide_label()
        advice = await parking.until(GuidanceState.LOST)
        assert "hidden" in advice.words.headline
        scene.garage.world.show_label()
        await parking.until(MOVE, STOP, GOOD)

    on_scene(scenario, seed=3, settings=quick())


def test_an_unplugged_camera_is_said_and_recovered_from() -> None:
    async def scenario(scene: Scene) -> None:
        park_in_the_middle(scene)
        parking = Parking(scene)
        await parking.watch(2.0)
        assert parking.advice.state is GOOD
        scene.garage.camera.fault = CameraFault.UNPLUGGED
        advice = await parking.until(GuidanceState.PAUSED)
        assert advice.words == PAUSED[PauseReason.CAMERA_DOWN]
        scene.garage.camera.fault = CameraFault.NONE
        await parking.until(GOOD)
        scene.garage.camera.fault = CameraFault.DARK
        assert (await parking.until(GuidanceState.UNREADABLE)).words.headline == "It is too dark"

    on_scene(scenario, seed=3, settings=quick())


def test_a_car_that_has_always_stood_here_is_no_arrival() -> None:
    async def scenario(scene: Scene) -> None:
        park_in_the_middle(scene)
        parking = Parking(scene)
        await parking.watch(5.0)
        assert parking.advice.state is GOOD
        assert not parking.arriving()

    on_scene(scenario, seed=3, settings=quick())


def test_an_arrival_is_over_some_time_after_the_car_has_stopped() -> None:
    async def scenario(scene: Scene) -> None:
        park_in_the_middle(scene)
        parking = Parking(scene)
        parking.arrive(from_mm=400.0)
        await parking.until(GOOD)
        assert parking.arriving()
        await parking.watch(scene.services.settings.guidance.settled_s + 2.0)
        assert not parking.arriving()
        parking.traffic.leave(scene.now_s)
        await parking.until(GuidanceState.SEARCHING)
        assert not parking.arriving()

    on_scene(scenario, seed=3, settings=quick())


def test_it_never_looks_while_a_job_has_the_robot_and_never_moves_it() -> None:
    async def scenario(scene: Scene) -> None:
        park_in_the_middle(scene)
        parking = Parking(scene)
        before = scene.truth().T_base_plug
        await parking.watch(3.0)
        assert np.array_equal(scene.truth().T_base_plug, before)
        job = await scene.start(JobType.PLUG_IN)
        await parking.watch(0.6)
        assert parking.advice.words == PAUSED[PauseReason.ROBOT_BUSY]
        looked_at_s = parking.looked_at_s()
        while not (await scene.services.jobs.get(job.id)).state.ended:  # type: ignore[union-attr]
            await parking.watch(1.0)
        assert parking.looked_at_s() == looked_at_s
        await parking.watch(1.0)
        assert scene.services.supervisor.plug.state is PlugState.INSERTED
        assert parking.advice.words == PAUSED[PauseReason.PLUG_HELD]

    on_scene(scenario, seed=3, settings=quick())


def test_nobody_watches_and_the_camera_rests() -> None:
    async def scenario(scene: Scene) -> None:
        parking = Parking(scene)
        await scene.later(5.0)
        assert parking.looked_at_s() is None
        parking.guide.ask()
        await scene.later(1.0)
        assert parking.looked_at_s() is not None
        await scene.later(scene.services.settings.guidance.asked_s)
        looked_at_s = parking.looked_at_s()
        await scene.later(5.0)
        assert parking.looked_at_s() == looked_at_s

    on_scene(scenario, seed=3, settings=quick())


def test_a_robot_that_does_not_know_its_place_gives_no_guidance() -> None:
    async def scenario(scene: Scene) -> None:
        parking = Parking(scene)
        await parking.watch(1.0)
        assert parking.advice.words == PAUSED[PauseReason.ROBOT_NOT_HOMED]
        supervisor = scene.services.supervisor
        async with supervisor.control("homing", "Test") as lease:
            await supervisor.enable(lease)
            await supervisor.home(lease)
        await parking.watch(1.0)
        assert parking.advice.state is not GuidanceState.PAUSED
        async with supervisor.control("jog", "Test") as lease:
            scene.garage.world.remove_car()
            joints = supervisor.telemetry.require().measured.position
            await supervisor.move_joints(lease, joints._replace(rho3_mm=90.0))
        await parking.watch(1.0)
        assert parking.advice.words == PAUSED[PauseReason.ROBOT_NOT_PARKED]
        scene.garage.robot.unplug_link()
        await parking.watch(2.0)
        assert parking.advice.words == PAUSED[PauseReason.ROBOT_OFFLINE]

    on_scene(scenario, seed=3, parked=False, settings=quick())
