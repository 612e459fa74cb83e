"""What is wrong with the robot is noticed and named, and what is in force stays in force."""

from __future__ import annotations

import numpy as np
import pytest

from drivers.simulator.truth import mechanism_from_below
from drivers.simulator.world import SimulatedWorld
from server.calibration.routines import robot_routine, stand
from server.calibration.versions.new_calibration import NewCalibration
from server.calibration.versions.values import rotation_vector
from server.schema.calibrations import CalibrationKind, RobotValues
from server.schema.routines import RobotRoutineRequest, Routine
from tests.support.garage import Scene, on_scene
from twin.as_built import PlanarAsBuilt
from twin.kinematics import PlatformPosition

SWAPPED = np.array([[0.0, 1.0], [1.0, 0.0]])
SWITCH_MM = 3.0


@pytest.fixture(autouse=True)
def short(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ten poses and one picture of each."""
    monkeypatch.setattr(robot_routine, "POSES", 10)
    monkeypatch.setattr(robot_routine, "FEWEST_LOOKS", 8)
    monkeypatch.setattr(stand, "FRAMES", 1)


def rewire(world: SimulatedWorld, wiring: np.ndarray, monkeypatch: pytest.MonkeyPatch) -> None:
    """From where the robot stands now, the carriages go where the wiring has the motors go."""
    plant, here = world.plant, world.advance(world.now_s).carriages
    start = np.array([here.rho1_mm, here.rho2_mm])

    def platform(rho1_mm: float, rho2_mm: float) -> PlatformPosition:
        left_mm, right_mm = start + wiring @ (np.array([rho1_mm, rho2_mm]) - start)
        return plant.mechanism.forward(float(left_mm), float(right_mm))

    monkeypatch.setattr(plant, "_sagged", platform)


async def put_in_force(scene: Scene, mechanism: PlanarAsBuilt) -> str:
    """A calibration that somebody has entered."""
    services = scene.services
    mount = services.settings.camera.mount.T_platform_camera[:3, :3]
    values = RobotValues(mechanism=mechanism, camera_rotation_rad=rotation_vector(mount))
    kept = await services.calibrations.keep(NewCalibration(values, "Anna", "by hand"))
    await services.calibrations.activate(kept.id, by="Anna", accept_worse=True)
    return kept.id


async def robot_in_force(scene: Scene) -> str:
    page = await scene.services.calibrations.page(kind=CalibrationKind.ROBOT, before=None, limit=10)
    (one,) = [version.id for version in page if version.in_force]
    return one


async def carried_out(scene: Scene) -> Routine:
    await scene.services.routines.begin(RobotRoutineRequest(), "Anna")
    await scene.services.routines.wait()
    routine = scene.services.routines.shown
    assert routine is not None
    return routine


@pytest.mark.parametrize("seed", [2, 3])
@pytest.mark.parametrize(
    ("wiring", "code", "word"),
    [
        (SWAPPED, "calibration_axes_swapped", "the other one"),
        (np.diag([-1.0, 1.0]), "calibration_motor_reversed", "left"),
        (np.diag([1.0, -1.0]), "calibration_motor_reversed", "right"),
    ],
)
def test_a_wrongly_connected_motor_is_named(
    wiring: np.ndarray, code: str, word: str, seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    async def scenario(scene: Scene) -> None:
        drawn = PlanarAsBuilt.as_drawn(scene.services.settings.geometry)
        in_force = await put_in_force(scene, drawn)
        rewire(scene.garage.world, wiring, monkeypatch)
        routine = await carried_out(scene)
        assert routine.problem is not None
        assert routine.problem.code == code, routine.problem.detail
        assert word in routine.problem.detail
        assert routine.state == "failed"
        assert routine.calibration_id is None
        assert await robot_in_force(scene) == in_force

    on_scene(scenario, seed=seed)


def test_a_limit_switch_that_was_moved_is_named() -> None:
    async def scenario(scene: Scene) -> None:
        world = scene.garage.world
        true = mechanism_from_below(
            world.plant, world.surroundings.zero, world.parameters.drives.backlash_mm
        )
        then = true.right_foot_x_mm - SWITCH_MM
        in_force = await put_in_force(scene, true.model_copy(update={"right_foot_x_mm": then}))
        routine = await carried_out(scene)
        assert routine.problem is None
        assert routine.calibration_id is not None
        found = await scene.services.calibrations.get(routine.calibration_id)
        said = [remark for remark in found.remarks if "limit switch" in remark]
        assert len(said) == 1, found.remarks
        assert "3.0 mm further apart" in said[0] or "2.9 mm" in said[0] or "3.1 mm" in said[0]
        assert await robot_in_force(scene) == in_force, "nobody has asked for another one"

    on_scene(scenario, seed=2)
