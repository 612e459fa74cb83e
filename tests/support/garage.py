"""The whole server without its pages, on the simulator, in virtual time."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TypeVar

import numpy as np

from drivers.simulator.garage import SimulatedGarage
from drivers.simulator.poses import rotation_y
from drivers.simulator.truth import GroundTruth
from drivers.station import StationSnapshot
from server.composition import running
from server.config.settings import Settings
from server.jobs.approach import parking_joints
from server.jobs.model import JobPhase, JobType
from server.schema.jobs import Job, JobEvent, JobRequest
from server.services import Services
from server.timing import VirtualTimeLoop

T = TypeVar("T")

LONG_S = 200.0
"""Virtual time after which a scenario is given up."""


@dataclass
class Scene:
    """A server whose robot is parked, and what a test wants to know about it.

    Attributes:
        services: The running parts.
        seen: Every phase in which a job began, in order.
    """

    services: Services
    seen: list[JobPhase] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.services.runner.listen(self._remember)

    @property
    def garage(self) -> SimulatedGarage:
        assert self.services.garage is not None
        return self.services.garage

    @property
    def now_s(self) -> float:
        return asyncio.get_running_loop().time()

    def truth(self) -> GroundTruth:
        """What is really so, now."""
        return self.garage.world.truth(self.now_s)

    async def start(self, job_type: JobType, energy_wh: float | None = None) -> Job:
        request = JobRequest(type=job_type, target_energy_wh=energy_wh)
        return await self.services.runner.create(request, key=None, digest=None)

    async def ended(self, job: Job) -> Job:
        """Wait for a job's end and return it as it is kept."""
        await self.services.runner.wait()
        kept = await self.services.jobs.get(job.id)
        assert kept is not None
        assert kept.state.ended
        return kept

    async def carried_out(self, job_type: JobType, energy_wh: float | None = None) -> Job:
        return await self.ended(await self.start(job_type, energy_wh))

    async def until(self, condition: Callable[[], bool], step_s: float = 0.01) -> None:
        """Let virtual time pass until something is so."""
        while not condition():  # noqa: ASYNC110 - in virtual time a look costs nothing
            await asyncio.sleep(step_s)

    async def later(self, delay_s: float) -> None:
        """Let that much virtual time pass."""
        await asyncio.sleep(delay_s)

    async def until_phase(self, phase: JobPhase) -> None:
        """Let virtual time pass until a job's newest phase is this one."""
        await self.until(lambda: bool(self.seen) and self.seen[-1] is phase)

    async def until_moving(self) -> None:
        """Let virtual time pass until the robot moves well."""
        await self.until(lambda: self._speed_mm_s() > 3.0)

    async def until_at_rest(self) -> None:
        """Let virtual time pass until the robot stands."""
        await self.until(lambda: self._speed_mm_s() == 0.0)

    def _speed_mm_s(self) -> float:
        state = self.services.supervisor.telemetry.require()
        return max(map(abs, state.commanded.velocity))

    async def still(self, for_s: float = 0.5) -> bool:
        """Whether nothing moves for that long."""
        before = self.truth().T_base_plug
        await asyncio.sleep(for_s)
        return bool(abs(self.truth().T_base_plug - before).max() < 1e-3)

    async def station(self) -> StationSnapshot:
        return await self.garage.station.snapshot()

    async def kinds(self, job: Job) -> list[str]:
        """Kinds of the entries in a job's journal."""
        return [event.kind for event in await self.events(job)]

    async def events(self, job: Job) -> list[JobEvent]:
        return await self.services.jobs.events(job.id)

    def _remember(self) -> None:
        job = self.services.runner.newest
        if job is not None and (not self.seen or self.seen[-1] is not job.phase):
            self.seen.append(job.phase)


def on_scene(
    scenario: Callable[[Scene], Awaitable[T]],
    *,
    seed: int = 1,
    folder: Path | None = None,
    parked: bool = True,
    settings: Settings | None = None,
) -> T:
    """Run a scenario in virtual time.

    Args:
        scenario: Gets the scene.
        seed: Of the garage.
        folder: Keeps data there instead of in memory.
        parked: Begin with a robot that is homed, stands at its parking place and is switched on.
        settings: Instead of the defaults; the seed is put in.
    """
    chosen = settings or Settings()
    simulation = chosen.simulation.model_copy(update={"seed": seed})
    chosen = chosen.model_copy(update={"simulation": simulation})
    if parked:
        chosen = _standing_parked(chosen)

    async def main() -> T:
        async with running(chosen, folder=folder) as services:
            if parked:
                await _switch_on(services)
            async with asyncio.timeout(LONG_S):
                return await scenario(Scene(services))

    with asyncio.Runner(loop_factory=VirtualTimeLoop) as runner:
        return runner.run(main())


def _standing_parked(settings: Settings) -> Settings:
    """The robot was homed and parked by somebody else: hundreds of tests need not wait for it."""
    joints = parking_joints(settings.geometry, settings.park)
    board = settings.simulation.parameters.board.model_copy(
        update={"start_homed": True, "start_joints": joints}
    )
    parameters = settings.simulation.parameters.model_copy(update={"board": board})
    simulation = settings.simulation.model_copy(update={"parameters": parameters})
    return settings.model_copy(update={"simulation": simulation})


async def _switch_on(services: Services) -> None:
    supervisor = services.supervisor
    async with supervisor.control("homing", "Start of the scene") as lease:
        await supervisor.enable(lease)
        await supervisor.plug.is_parked()


def shift_car(
    garage: SimulatedGarage,
    *,
    x_mm: float = 0.0,
    y_mm: float = 0.0,
    z_mm: float = 0.0,
    yaw_rad: float = 0.0,
) -> None:
    """The same car parks elsewhere: shifted in the base frame and turned about its socket."""
    car = garage.world.car
    turn = rotation_y(yaw_rad)
    socket, label = car.T_base_socket.copy(), car.T_base_label.copy()
    centre = socket[:3, 3]
    shift = np.array([x_mm, y_mm, z_mm])
    label[:3, 3] = centre + turn @ (label[:3, 3] - centre) + shift
    label[:3, :3] = turn @ label[:3, :3]
    socket[:3, :3] = turn @ socket[:3, :3]
    socket[:3, 3] = centre + shift
    garage.world.put_car(replace(car, T_base_label=label, T_base_socket=socket))
