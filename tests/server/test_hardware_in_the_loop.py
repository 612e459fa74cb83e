"""A whole job with a robot that is not the garage's own, in virtual time."""

from __future__ import annotations

import asyncio

from drivers.registry import SIMULATOR, DeviceRequest, Devices, make_devices
from drivers.simulator.garage import FollowedGarage, SimulatedGarage, build_followed_garage
from server.composition import running
from server.config.robot import RobotSettings
from server.config.settings import Settings
from server.jobs.model import JobState, JobType
from server.schema.jobs import Job, JobRequest
from server.schema.live import SnapshotMessage
from server.simulation import park_first
from server.timing import VirtualTimeLoop

SEED = 3


def around_another_robot(settings: Settings) -> tuple[Devices, SimulatedGarage, FollowedGarage]:
    """Camera and station of one garage, and the robot of another with the same car."""
    elsewhere = make_devices(
        DeviceRequest(
            robot=SIMULATOR,
            camera=SIMULATOR,
            station=SIMULATOR,
            port="",
            geometry=settings.geometry,
            limits=settings.motion,
            mount=settings.camera.mount,
            optics=settings.camera.optics,
            simulation=settings.simulation.parameters,
            seed=SEED,
        )
    ).garage
    assert elsewhere is not None
    around = build_followed_garage(
        settings.geometry,
        settings.motion,
        settings.camera.mount,
        settings.camera.optics,
        settings.simulation.parameters,
        seed=SEED,
    )
    devices = Devices(elsewhere.robot, around.camera, around.station, None, around)
    return devices, elsewhere, around


def test_a_followed_robot_plugs_the_simulated_car_in_and_out() -> None:
    settings = Settings(robot=RobotSettings(driver="arduino"))
    jobs: list[Job] = []
    shown: list[SnapshotMessage] = []
    seated: list[bool] = []

    async def main() -> None:
        devices, elsewhere, around = around_another_robot(settings)
        async with running(settings, folder=None, devices=devices) as services:
            await park_first(services)
            for job_type in (JobType.PLUG_IN, JobType.UNPLUG):
                request = JobRequest(type=job_type)
                job = await services.runner.create(request, key=None, digest=None)
                await services.runner.wait()
                ended = await services.jobs.get(job.id)
                assert ended is not None
                jobs.append(ended)
                seated.append(around.world.truth().seated)
            shown.append(SnapshotMessage.model_validate_json(await anext(services.live.watch())))
            truth, there = around.world.truth(), elsewhere.world.truth()
            assert truth.lateral_error_mm < 0.5
            assert abs(truth.lateral_error_mm - there.lateral_error_mm) < 0.05
            assert abs(truth.max_contact_force_n - there.max_contact_force_n) < 5.0
            assert truth.load_breaks == 0

    with asyncio.Runner(loop_factory=VirtualTimeLoop) as runner:
        runner.run(main())
    assert [job.state for job in jobs] == [JobState.SUCCEEDED] * 2, jobs[-1].error
    assert seated == [True, False]
    service = shown[0].live.service
    assert not service.simulated
    assert service.simulated_parts == ["camera", "station"]
    assert service.speed == 1.0
