"""Whole jobs on the simulator in virtual time: as long as their computation takes."""

from __future__ import annotations

import asyncio
import time
from dataclasses import dataclass

from server.composition import running
from server.config.settings import Settings
from server.jobs.approach import parking_joints
from server.jobs.model import JobState
from server.schema.jobs import Job, JobEvent, JobRequest
from server.services import Services
from server.timing import VirtualTimeLoop


@dataclass(frozen=True, slots=True)
class PhaseTime:
    """How long a phase took, in simulated seconds since the job was accepted."""

    phase: str
    started_s: float
    duration_s: float


@dataclass(frozen=True, slots=True)
class SimulatedJob:
    """What became of one job, as the simulated garage really saw it.

    Attributes:
        seed: Of the garage.
        job: The job as the API shows it; its result holds what the robot itself measured.
        phases: How long each phase took.
        lateral_error_mm: True distance of the plug's axis from the socket's centre at the entry.
        insertion_depth_mm: True depth at the end of the insertion.
        max_force_n: Largest force that really acted between plug and socket, or that the board
            measured, whichever is larger.
        duration_s: From acceptance to the plug seated; to the end for a job that got not so far.
        limit_duration_s: The same motion if only the joint limits mattered.
        divergences: What the model beside the robot found, in words.
        wall_s: Computing time.
    """

    seed: int
    job: Job
    phases: list[PhaseTime]
    lateral_error_mm: float | None
    insertion_depth_mm: float | None
    max_force_n: float
    duration_s: float
    limit_duration_s: float | None
    divergences: list[str]
    wall_s: float

    @property
    def succeeded(self) -> bool:
        """The job did what it was asked for."""
        return self.job.state is JobState.SUCCEEDED


def simulate(settings: Settings, request: JobRequest) -> SimulatedJob:
    """Run one job from the parking place in a garage of its own.

    The robot is switched on, homed and parked before the job is accepted, as it would be in a
    garage; that time does not count.
    """
    with asyncio.Runner(loop_factory=VirtualTimeLoop) as runner:
        return runner.run(_simulate(settings, request))


async def _simulate(settings: Settings, request: JobRequest) -> SimulatedJob:
    began = time.perf_counter()
    async with running(settings, folder=None) as services:
        await park_first(services)
        job = await services.runner.create(request, key=None, digest=None)
        truth = _SeatedTruth(services)
        services.runner.listen(truth.notice)
        await services.runner.wait()
        events = await services.jobs.events(job.id)
        ended = await services.jobs.get(job.id)
    assert ended is not None  # noqa: S101 - it was accepted a moment ago
    phases = _phase_times(events, job)
    seated_s = ended.result.plugged_after_s
    return SimulatedJob(
        seed=settings.simulation.seed,
        job=ended,
        phases=phases,
        lateral_error_mm=truth.lateral_error_mm,
        insertion_depth_mm=truth.insertion_depth_mm,
        max_force_n=truth.max_force_n(ended),
        duration_s=seated_s if seated_s is not None else phases[-1].started_s,
        limit_duration_s=ended.result.limit_duration_s,
        divergences=[event.message for event in events if event.kind == "divergence"],
        wall_s=time.perf_counter() - began,
    )


async def park_first(services: Services) -> None:
    """Switch the robot on, home it and send it to its parking place."""
    supervisor = services.supervisor
    async with supervisor.control("homing", "Start of the simulation") as lease:
        await supervisor.enable(lease)
        await supervisor.home(lease)
        await supervisor.move_from_below(
            lease, parking_joints(supervisor.geometry, services.settings.park)
        )
        await supervisor.plug.is_parked()


class _SeatedTruth:
    """Asks the simulated garage for the truth at the moment the robot says the plug is in."""

    def __init__(self, services: Services) -> None:
        assert services.garage is not None  # noqa: S101 - this module runs the simulator only
        self._world = services.garage.world
        self._runner = services.runner
        self.lateral_error_mm: float | None = None
        self.insertion_depth_mm: float | None = None
        self._seen = False

    def notice(self) -> None:
        job = self._runner.newest
        if not self._seen and job is not None and job.result.plugged_after_s is not None:
            self._seen = True
            truth = self._world.truth()
            self.lateral_error_mm = truth.lateral_error_mm
            self.insertion_depth_mm = truth.insertion_depth_mm

    def max_force_n(self, job: Job) -> float:
        return max(self._world.truth().max_contact_force_n, job.result.max_force_n or 0.0)


def _phase_times(events: list[JobEvent], job: Job) -> list[PhaseTime]:
    starts = [event for event in events if event.kind == "phase_started"]
    ends = [*(event.at for event in starts[1:]), events[-1].at]
    return [
        PhaseTime(
            phase=event.phase.value,
            started_s=(event.at - job.created_at).total_seconds(),
            duration_s=(end - event.at).total_seconds(),
        )
        for event, end in zip(starts, ends, strict=True)
    ]
