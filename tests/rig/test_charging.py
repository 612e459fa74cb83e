"""The whole charging job: server, real driver, real firmware, and a garage around the motors."""

from __future__ import annotations

import pytest

from drivers import registry
from drivers.simulator.parameters import SimulationParameters
from server.composition import running
from server.config.robot import RobotSettings
from server.config.settings import Settings
from server.jobs.model import JobState, JobType
from server.schema.jobs import JobRequest
from server.schema.vehicles import SocketOffset, VehicleSettings
from server.services import Services
from server.simulation import park_first
from tests.rig.build import Programs
from tests.rig.garage import GarageAroundRig
from tests.rig.rig import running_rig


async def introduce_car(services: Services, around: GarageAroundRig) -> None:
    """Make the garage's car known, as its owner would have measured it."""
    car = around.garage.world.car
    offset = car.known_offset
    await services.vehicles.put(
        car.payload.rsplit(":", 1)[-1],
        VehicleSettings(
            name="Car in the rig",
            label_size_mm=car.label_size_mm,
            socket=SocketOffset(
                x_mm=offset.x_mm,
                y_mm=offset.y_mm,
                z_mm=offset.z_mm,
                rotation_x_rad=offset.rotation_x_rad,
                rotation_y_rad=offset.rotation_y_rad,
            ),
        ),
    )


async def test_a_car_is_plugged_in(programs: Programs, monkeypatch: pytest.MonkeyPatch) -> None:
    async with running_rig(programs) as rig:
        robot = RobotSettings(driver="arduino", port=str(rig.port), board=rig.machine.settings)
        settings = Settings(robot=robot)
        around = GarageAroundRig(rig, settings.camera.optics, SimulationParameters(), seed=1)
        garage = around.garage
        monkeypatch.setitem(registry.CAMERAS, "simulator", lambda _: garage.camera)
        monkeypatch.setitem(registry.STATIONS, "simulator", lambda _: garage.station)
        async with running(settings, folder=None) as services:
            await introduce_car(services, around)
            await park_first(services)
            request = JobRequest(type=JobType.PLUG_IN)
            job = await services.runner.create(request, key=None, digest=None)
            await services.runner.wait()
            ended = await services.jobs.get(job.id)
        assert ended is not None
        truth = garage.world.truth()
        assert ended.state is JobState.SUCCEEDED
        assert truth.seated
        assert truth.lateral_error_mm < 1.5
        assert truth.max_contact_force_n < 90.0
        assert ended.result.insertion_depth_mm == pytest.approx(truth.insertion_depth_mm, abs=1.0)
