"""A socket is taught by the plug in it; jobs then find it although the robot is built badly."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.calibration.routines.socket_routine import (
    SocketRoutine,
    mated_socket,
    missed_mm,
    offset_of,
)
from server.calibration.routines.stand import Stand
from server.config.settings import Settings
from server.control.model import PlugState
from server.jobs.model import JobState, JobType
from server.localisation.frames import label_from_socket
from server.schema.calibrations import CalibrationKind
from server.schema.routines import Routine, SocketRoutineRequest
from server.schema.vehicles import SocketOffset
from server.simulated_calibration import before_calibration
from server.simulated_technician import SimulatedTechnician
from server.simulation import park_first
from tests.support.garage import Scene, on_scene, shift_car
from twin.geometry import RobotGeometry
from twin.joints import JointPosition
from twin.kinematics import gamma

SOCKET = CalibrationKind.SOCKET


def badly_built() -> Settings:
    settings = Settings()
    parameters = settings.simulation.parameters
    parameters = parameters.model_copy(update={"build": before_calibration(parameters.build)})
    simulation = settings.simulation.model_copy(update={"parameters": parameters})
    return settings.model_copy(update={"simulation": simulation})


def technician(scene: Scene) -> SimulatedTechnician:
    return SimulatedTechnician(scene.services, scene.garage.world, np.random.default_rng(1))


async def teach(scene: Scene) -> Routine:
    await scene.services.routines.begin(SocketRoutineRequest(), "Anna")
    await scene.services.routines.wait()
    routine = scene.services.routines.shown
    assert routine is not None
    return routine


def test_a_job_finds_the_taught_socket_again() -> None:
    async def scenario(scene: Scene) -> None:
        services = scene.services
        await technician(scene).plug_in_by_hand()
        assert scene.truth().seated
        routine = await teach(scene)
        assert routine.problem is None
        assert services.supervisor.plug.state is PlugState.FREE
        assert scene.truth().insertion_depth_mm < 0, "the plug was drawn out"
        assert scene.truth().lateral_violation_mm < 0.05
        assert routine.calibration_id is not None
        found = await services.calibrations.get(routine.calibration_id)
        assert found.error_in_use is not None
        assert found.error_in_use > 1.0, "where the owner measured it, this robot misses it"
        assert found.error is not None
        assert found.error < 0.1, "on the same look, across the same axis"
        (vehicle,) = await services.vehicles.all()
        assert services.calibrations.as_taught(vehicle) == vehicle
        await services.calibrations.activate(found.id, by="Anna", accept_worse=False)
        assert services.calibrations.as_taught(vehicle).socket != vehicle.socket
        await park_first(services)
        shift_car(scene.garage, x_mm=12.0, y_mm=-8.0)
        job = await scene.carried_out(JobType.PLUG_IN)
        assert job.state is JobState.SUCCEEDED
        assert scene.truth().lateral_error_mm < 0.3

    on_scene(scenario, seed=3, settings=badly_built())


def test_a_taught_socket_is_rolled_back_alone() -> None:
    async def scenario(scene: Scene) -> None:
        services = scene.services
        job = await scene.carried_out(JobType.PLUG_IN)
        assert job.state is JobState.SUCCEEDED
        routine = await teach(scene)
        assert routine.calibration_id is not None
        await services.calibrations.activate(routine.calibration_id, by="A", accept_worse=True)
        (taught,) = services.calibrations.versions_in_force
        assert taught.kind is SOCKET
        await services.calibrations.roll_back(SOCKET, by="Ben", subject="demo")
        assert services.calibrations.versions_in_force == []

    on_scene(scenario, seed=2)


def test_without_the_plug_in_it_nothing_is_taught_and_nothing_moves() -> None:
    async def scenario(scene: Scene) -> None:
        before = scene.services.supervisor.telemetry.require().measured.position
        routine = await teach(scene)
        assert routine.state == "interrupted"
        assert routine.problem is not None
        assert routine.problem.code == "calibration_plug_not_in"
        assert scene.services.supervisor.telemetry.require().measured.position == before
        assert scene.services.supervisor.plug.state is PlugState.PARKED

    on_scene(scenario, seed=2)


def test_a_car_that_rocks_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    draw_out = SocketRoutine._draw_out

    async def scenario(scene: Scene) -> None:
        async def rocks(self: SocketRoutine, stand: Stand) -> None:
            await draw_out(self, stand)
            shift_car(scene.garage, x_mm=0.5)

        monkeypatch.setattr(SocketRoutine, "_draw_out", rocks)
        await technician(scene).plug_in_by_hand()
        routine = await teach(scene)
        assert routine.state == "failed"
        assert routine.problem is not None
        assert routine.problem.code == "calibration_label_moved"
        assert not await scene.services.calibrations.page(kind=None, before=None, limit=5)

    on_scene(scenario, seed=2)


ANGLES = st.floats(-0.3, 0.3)


@given(ANGLES, ANGLES, st.lists(st.floats(-100, 100), min_size=3, max_size=3))
def test_the_offset_says_where_the_socket_is(
    about_x_rad: float, about_y_rad: float, place: list[float]
) -> None:
    x_mm, y_mm, z_mm = place
    offset = SocketOffset(
        x_mm=x_mm,
        y_mm=y_mm,
        z_mm=z_mm,
        rotation_x_rad=about_x_rad,
        rotation_y_rad=about_y_rad,
    )
    again = offset_of(label_from_socket(offset))
    assert list(again.model_dump().values()) == pytest.approx(list(offset.model_dump().values()))


def test_taught_and_used_places_are_measured_alike() -> None:
    socket = mated_socket(RobotGeometry(), JointPosition(150.0, 180.0, 120.0), 40.0)
    taught = SocketOffset(x_mm=60.0, y_mm=5.0, z_mm=20.0, rotation_x_rad=0.1, rotation_y_rad=0.0)
    label = socket @ np.linalg.inv(label_from_socket(taught))
    assert missed_mm(label, taught, socket) == pytest.approx(0.0, abs=1e-9)
    beside = taught.model_copy(update={"x_mm": 60.7})
    assert missed_mm(label, beside, socket) == pytest.approx(0.7)
    across, along = label_from_socket(taught)[:3, 1:3].T @ np.array([0.0, 0.0, 1.0])
    deeper = taught.model_copy(update={"z_mm": 20.7})
    assert missed_mm(label, deeper, socket) == pytest.approx(0.7 * abs(across))
    assert abs(along) > 0.9


def test_the_socket_of_a_mated_plug_lies_behind_the_tip() -> None:
    geometry = RobotGeometry()
    joints = JointPosition(150.0, 180.0, 120.0)
    socket = mated_socket(geometry, joints, 40.0)
    tip_at_face = gamma.forward(geometry, joints._replace(rho3_mm=80.0))
    np.testing.assert_allclose(socket[:3, 3], tip_at_face, atol=1e-9)
    np.testing.assert_allclose(socket[:3, :3].T @ socket[:3, :3], np.eye(3), atol=1e-12)
    assert np.linalg.det(socket[:3, :3]) == pytest.approx(1.0)
