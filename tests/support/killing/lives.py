"""A job through several lives of its server."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from server.control.model import PlugState
from server.control.plug_guard import HELD
from server.jobs.model import JobState, JobType
from server.jobs.recovery import SEATED
from server.schema.jobs import Job, JobEvent, JobRequest
from server.services import Services
from server.timing import VirtualTimeLoop
from tests.support.killing.garage import ImmortalGarage, Killed, patience

LONG_S = 300.0
DARK_S = 2.0
ENERGY_WH = 30.0
SOME_LATERAL_MM = 0.01
"""Numerical noise of a motor that is numbered anew; belts transmit fifty times as much."""


@dataclass
class Lives:
    """What became of a job over several lives of its server."""

    works: int = 0
    accepted: bool = False
    job: Job | None = None
    events: list[JobEvent] = field(default_factory=list)
    plug: PlugState | None = None


KillAt = Callable[[int, str], bool]


def live_through(
    folder: Path,
    request: JobRequest,
    kills: list[KillAt],
    *,
    plugged: bool = False,
    dark: bool = False,
) -> Lives:
    """Run a job through as many deaths as there are ``kills``, then to its end.

    Args:
        folder: Of the database.
        request: The job.
        kills: For each life, at which piece of work it ends.
        plugged: Plug the car in first.
        dark: Each death is a power cut of the whole house.
    """
    lives = Lives()

    async def main() -> None:
        garage = ImmortalGarage(folder, 3)
        todo = list(kills)

        def arm(services: Services) -> None:
            kill_at = todo.pop(0) if todo else None

            def counted(number: int, when: str) -> bool:
                lives.works = number
                return kill_at is not None and kill_at(number, when)

            garage.on_write(services.database, counted)

        async def first(services: Services) -> None:
            await _wake_up(services)
            if plugged:
                await services.runner.create(JobRequest(type=JobType.PLUG_IN), key=None, digest="")
                await services.runner.wait()
            arm(services)
            await services.runner.create(request, key="once", digest="")
            lives.accepted = True
            await services.runner.wait()

        async def another(services: Services) -> None:
            if todo:
                arm(services)
            await services.runner.wait()
            await asyncio.sleep(1.0)  # a job that waited begins a moment later
            await services.runner.wait()

        async def last(services: Services) -> None:
            await another(services)
            known = await services.jobs.by_key("once")
            lives.job = known[0] if known else None
            if lives.job is not None:
                lives.events = await services.jobs.events(lives.job.id)
            lives.plug = services.supervisor.plug.state
            station = await garage.garage.station.snapshot()
            assert not station.held or lives.plug is PlugState.INSERTED

        async with patience(LONG_S * (len(kills) + 1)):
            life = first
            for _ in kills:
                try:
                    await garage.live(life)
                except Killed:
                    if dark:
                        garage.cut_power()
                    await asyncio.sleep(DARK_S)
                life = another
            await garage.live(last if kills else first)
        truth = garage.truth()
        assert truth.lateral_violation_mm < SOME_LATERAL_MM
        assert truth.load_breaks == 0
        assert truth.max_contact_force_n < 85.0

    with asyncio.Runner(loop_factory=VirtualTimeLoop) as runner:
        runner.run(main())
    return lives


async def _wake_up(services: Services) -> None:
    """The robot stands in its parking place; nobody has told it so."""
    async with services.supervisor.control("homing", "Start of the simulation") as lease:
        await services.supervisor.enable(lease)
    await services.supervisor.plug.is_parked()


REQUESTS = {
    "charge": JobRequest(type=JobType.CHARGE, target_energy_wh=ENERGY_WH),
    "plug_in": JobRequest(type=JobType.PLUG_IN),
    "unplug": JobRequest(type=JobType.UNPLUG),
}
ENDS = {"charge": PlugState.PARKED, "plug_in": PlugState.INSERTED, "unplug": PlugState.PARKED}


def assert_done(lives: Lives, kind: str) -> None:
    assert lives.job is not None
    assert lives.job.state is JobState.SUCCEEDED, lives.job.error
    assert [event.sequence for event in lives.events] == list(range(1, len(lives.events) + 1))
    if kind == "charge":
        assert (lives.job.result.energy_wh or 0.0) >= ENERGY_WH


def die_at_entry(kind: str, when: str, number: int, folder: Path, *, dark: bool) -> bool:
    """Run a job whose server dies at one piece of work, and judge what becomes of it.

    Args:
        kind: Of job.
        when: "before" or "after" that piece of work.
        number: Of it, from 1.
        folder: Empty, for the database.
        dark: It is a power cut of the whole house.

    Returns:
        Whether the job got so far at all.

    Raises:
        AssertionError: something is not as it should be.
    """
    lives = live_through(
        folder,
        REQUESTS[kind],
        [lambda n, w: (n, w) == (number, when)],
        plugged=kind == "unplug",
        dark=dark,
    )
    if lives.works < number:
        return False
    if lives.job is None:
        assert not lives.accepted
        return True
    assert_done(lives, kind)
    resumed = [event.phase for event in lives.events if event.kind == "resumed"]
    if dark and resumed and resumed[-1] in SEATED and kind == "plug_in":
        # Nothing needed to move, so nothing was homed: how to get out sideways is not known.
        assert lives.plug in HELD
    elif resumed or not dark:
        # A robot that was dark after its job is not homed: where it stands is not known.
        assert lives.plug is ENDS[kind]
    return True
