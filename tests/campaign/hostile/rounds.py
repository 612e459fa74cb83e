"""Rounds of plugging in and unplugging, each job with an attack of its own."""

from __future__ import annotations

import asyncio
import random
from collections import Counter
from dataclasses import dataclass, field

from drivers.simulator.rival import Rival
from server.composition import running
from server.config.settings import Settings
from server.config.simulation import SimulationSettings
from server.control.model import PlugState, RobotMode
from server.jobs.model import JobState, JobType
from server.schema.jobs import Job, JobRequest
from server.services import Services
from server.simulation import park_first
from server.timing import VirtualTimeLoop
from tests.campaign.hostile.attacks import MISCHIEF, Attack, draw_attack, draw_garage
from tests.campaign.hostile.witness import Danger, Witness
from tests.support.knowing_eye import let_it_know

ENDS_WITHIN_S = 400.0
CHARGES_S = 4.0


@dataclass
class Figures:
    """What came of some rounds.

    Attributes:
        timings: Attacks.
        closings: The contactor closed while the plug was moving in the socket.
        enablings: The station was enabled while the plug was moving with the pilot contact made.
        begun: Motions of the plug that began in the socket.
        begun_under_load: Those that did with a closed contactor.
        load_breaks: The pilot contact parted with a closed contactor.
        lateral_mm: Largest sideways motion in the socket.
        outcomes: Codes of the errors that jobs ended with; "done" for those without.
        lost: After the attack there was no way back; each with its seed.
    """

    timings: int = 0
    closings: list[Danger] = field(default_factory=list)
    enablings: list[Danger] = field(default_factory=list)
    begun: int = 0
    begun_under_load: int = 0
    load_breaks: int = 0
    lateral_mm: float = 0.0
    outcomes: Counter[str] = field(default_factory=Counter)
    lost: list[str] = field(default_factory=list)

    def add(self, other: Figures) -> None:
        """Take in those of other rounds."""
        self.timings += other.timings
        self.closings += other.closings
        self.enablings += other.enablings
        self.begun += other.begun
        self.begun_under_load += other.begun_under_load
        self.load_breaks += other.load_breaks
        self.lateral_mm = max(self.lateral_mm, other.lateral_mm)
        self.outcomes.update(other.outcomes)
        self.lost += other.lost


def attack_in_one_garage(seed: int, timings: int) -> Figures:
    """So many attacks in one garage, in virtual time.

    Args:
        seed: Decides the garage and all attacks.
        timings: How many.
    """
    with asyncio.Runner(loop_factory=VirtualTimeLoop) as runner:
        return runner.run(_attack(seed, timings))


async def _attack(seed: int, timings: int) -> Figures:
    rng = random.Random(seed)
    numbers = draw_garage(rng)
    simulation = SimulationSettings(seed=seed, parameters=numbers)
    settings = Settings(simulation=simulation)
    period_s = settings.supervision.station_sample_s
    figures = Figures()
    async with running(settings, folder=None) as services:
        await park_first(services)
        let_it_know(services)
        assert services.garage is not None
        witness = Witness(services.garage, period_s + 2 * numbers.station.answer_s)
        while figures.timings < timings:
            job_type = JobType.UNPLUG if _is_in(services) else JobType.PLUG_IN
            if job_type is JobType.UNPLUG and rng.random() < 0.7:
                await services.garage.station.start()
                await asyncio.sleep(CHARGES_S)
            job = await _attacked(services, job_type, draw_attack(rng, job_type))
            figures.timings += 1
            figures.outcomes[job.error.code if job.error else "done"] += 1
            await witness.done()
            try:
                await _make_good(services, job, job_type, figures, seed)
            except LostPlugError as lost:
                figures.lost.append(str(lost))
                break
        truth = services.garage.world.truth()
    figures.closings, figures.enablings = witness.closings, witness.enablings
    figures.begun, figures.begun_under_load = witness.begun, witness.begun_under_load
    figures.load_breaks = truth.load_breaks
    figures.lateral_mm = truth.lateral_violation_mm
    return figures


async def _attacked(services: Services, job_type: JobType, attack: Attack) -> Job:
    """Carry out a job under attack; afterwards the attackers are gone."""
    assert services.garage is not None
    station = services.garage.station
    rival = Rival(station.point, attack.will)
    begun = asyncio.Event()

    def look() -> None:
        job = services.runner.newest
        if job is not None and job.state is JobState.RUNNING and job.phase is attack.phase:
            begun.set()

    async def make_trouble() -> None:
        await begun.wait()
        rival.let_loose()
        await asyncio.sleep(attack.mischief_after_s)
        MISCHIEF[attack.mischief](station)
        await asyncio.sleep(attack.mischief_for_s)
        station.behave()

    services.runner.listen(look)
    trouble = asyncio.create_task(make_trouble(), name="trouble")
    try:
        return await _carry_out(services, job_type)
    finally:
        trouble.cancel()
        await asyncio.gather(trouble, return_exceptions=True)
        services.runner._listeners.remove(look)
        await rival.calm()
        station.behave()


async def _carry_out(services: Services, job_type: JobType) -> Job:
    async with asyncio.timeout(ENDS_WITHIN_S):
        job = await services.runner.create(JobRequest(type=job_type), key=None, digest=None)
        await services.runner.wait()
    ended = await services.jobs.get(job.id)
    assert ended is not None
    assert ended.state.ended
    return ended


async def _make_good(
    services: Services, job: Job, job_type: JobType, figures: Figures, seed: int
) -> None:
    """As a person would, who finds the robot where the attack has left it."""
    supervisor = services.supervisor
    if supervisor.mode in {RobotMode.STOPPED, RobotMode.FAULT, RobotMode.EMERGENCY_STOP}:
        await supervisor.reset()
    assert services.garage is not None
    await services.garage.station.stop()
    wanted_in = job_type is JobType.PLUG_IN
    if job.error is not None and supervisor.plug.state is not PlugState.PARKED:
        again = await _carry_out(services, JobType.UNPLUG)
        if again.error is not None:
            raise LostPlugError(f"seed {seed}, timing {figures.timings}: {again.error.detail}")
    if wanted_in and not _is_in(services):
        await services.garage.station.release()
        again = await _carry_out(services, JobType.PLUG_IN)
        if again.error is not None:
            raise LostPlugError(f"seed {seed}, timing {figures.timings}: {again.error.detail}")


class LostPlugError(AssertionError):
    """After an attack there was no way back."""


def _is_in(services: Services) -> bool:
    return services.supervisor.plug.state is PlugState.INSERTED
