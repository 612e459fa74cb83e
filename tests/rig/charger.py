"""The whole charger: the server with the real driver at the rig, and a garage around the motors."""

from __future__ import annotations

import contextlib
from collections.abc import AsyncIterator
from dataclasses import dataclass

from drivers.registry import Devices
from drivers.simulator.garage import SimulatedGarage
from drivers.simulator.parameters import SimulationParameters
from server.composition import running
from server.config.robot import RobotSettings
from server.config.settings import Settings
from server.control.model import PlugState
from server.jobs.model import JobType
from server.schema.jobs import Job, JobRequest
from server.services import Services
from server.simulation import park_first
from tests.rig.build import Programs
from tests.rig.garage import GarageAroundRig
from tests.rig.rig import Rig, running_rig


@dataclass(frozen=True, slots=True)
class Charger:
    """Everything that runs.

    Attributes:
        rig: The board and its motors.
        garage: Around them.
        services: The server.
    """

    rig: Rig
    garage: SimulatedGarage
    services: Services


@contextlib.asynccontextmanager
async def running_charger(
    programs: Programs, *, parked: bool = True, seed: int = 1
) -> AsyncIterator[Charger]:
    """Run the server at a rig until the block ends.

    Args:
        programs: Firmware and simulator.
        parked: Switch the robot on, home it and park it first.
        seed: Decides everything random in the garage.
    """
    async with running_rig(programs) as rig:
        settings = Settings(robot=RobotSettings(driver="arduino", board=rig.machine.settings))
        garage = GarageAroundRig(rig, settings.camera.optics, SimulationParameters(), seed).garage
        devices = Devices(
            robot=rig.robot(), camera=garage.camera, station=garage.station, garage=garage
        )
        async with running(settings, folder=None, devices=devices) as services:
            if parked:
                await park_first(services)
            yield Charger(rig, garage, services)


async def do_job(services: Services, kind: JobType) -> Job:
    """Run a job to its end."""
    job = await services.runner.create(JobRequest(type=kind), key=None, digest=None)
    await services.runner.wait()
    ended = await services.jobs.get(job.id)
    assert ended is not None
    return ended


def plug_of(services: Services) -> PlugState:
    """Where the server takes the plug to be."""
    return services.supervisor.plug.state
