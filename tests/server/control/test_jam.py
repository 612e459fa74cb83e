from __future__ import annotations

import pytest

from drivers.robot import FaultCode
from drivers.simulator.parameters import SimulationParameters
from server.composition import running
from server.config.settings import Settings
from server.config.simulation import SimulationSettings
from server.control.model import PlugState, RobotMode
from server.jobs.model import JobState, JobType
from server.schema.jobs import Job, JobRequest
from server.services import Services
from server.simulation import park_first
from tests.support.virtual import run_virtual, wait_until


def tight_socket() -> Settings:
    """A socket that needs 120 N where 79 N are allowed."""
    numbers = SimulationParameters()
    contact = numbers.contact.model_copy(update={"peak_force_n": 120.0})
    numbers = numbers.model_copy(update={"contact": contact})
    return Settings(simulation=SimulationSettings(seed=3, parameters=numbers))


async def plug_in(services: Services) -> Job:
    await park_first(services)
    return await services.runner.create(JobRequest(type=JobType.PLUG_IN), key=None, digest=None)


async def ended(services: Services, job: Job) -> Job:
    await services.runner.wait()
    found = await services.jobs.get(job.id)
    assert found is not None
    return found


@pytest.mark.parametrize("stall_s", [0.1, 0.02], ids=["force watch first", "board stalls first"])
def test_a_jammed_plug_is_drawn_back_and_the_robot_parks(stall_s: float) -> None:
    settings = tight_socket()
    numbers = settings.simulation.parameters
    board = numbers.board.model_copy(update={"stall_s": stall_s})
    simulation = settings.simulation.model_copy(
        update={"parameters": numbers.model_copy(update={"board": board})}
    )
    settings = settings.model_copy(update={"simulation": simulation})

    async def scenario() -> None:
        async with running(settings, folder=None) as services:
            job = await ended(services, await plug_in(services))
            assert job.state is JobState.FAILED
            assert job.error is not None
            assert job.error.code == "insertion_jammed"
            assert job.error.context["depth_mm"] < 36.0
            supervisor = services.supervisor
            assert supervisor.plug.state is PlugState.PARKED
            assert supervisor.mode is RobotMode.READY
            assert supervisor.fault is None
            assert supervisor.holder is None
            assert services.garage is not None
            truth = services.garage.world.truth()
            # the board caps what its motor's current shows, which is a few per cent off
            assert truth.max_contact_force_n <= settings.insertion.force_limit_n * 1.03
            assert truth.max_contact_force_n > 70.0
            assert truth.lateral_violation_mm < 0.05
            assert truth.load_breaks == 0

    run_virtual(scenario())


def test_another_fault_during_the_insertion_is_for_a_person_to_look_at() -> None:
    async def scenario() -> None:
        async with running(Settings(), folder=None) as services:
            job = await plug_in(services)
            supervisor = services.supervisor
            await wait_until(lambda: supervisor.plug.state is PlugState.INSERTED)
            corridor = supervisor.plug.corridor
            assert corridor is not None
            await wait_until(
                lambda: (
                    supervisor.telemetry.require().measured.position.rho3_mm
                    > corridor.face_rho3_mm + 10.0
                )
            )
            assert services.garage is not None
            services.garage.robot.trip_limit(0)
            found = await ended(services, job)
            assert found.error is not None
            assert found.error.code == "robot_fault"
            assert supervisor.fault is not None
            assert supervisor.fault.code is FaultCode.LIMIT_SWITCH
            assert supervisor.plug.state is PlugState.UNKNOWN, "its positions are lost"
            assert supervisor.holder is None
            assert services.garage.world.truth().lateral_violation_mm < 0.05

    run_virtual(scenario())
