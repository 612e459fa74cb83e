"""What may be done to a job, drawn at random."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from drivers.simulator.parameters import SimulationParameters
from drivers.simulator.rival import Will
from drivers.simulator.station import SimulatedStation
from drivers.station import PilotState
from server.jobs.model import JobPhase, JobType

Act = Callable[[SimulatedStation], None]


def _lie(**fields: Any) -> Act:  # noqa: ANN401 - fields of a snapshot
    return lambda station: station.lie(**fields)


MISCHIEF: dict[str, Act] = {
    "nothing": lambda _: None,
    "lies: pilot B": _lie(pilot=PilotState.B),
    "lies: no current": _lie(currents_a=(0.0, 0.0, 0.0), power_w=0.0),
    "lies: contactor open": _lie(contactor_closed=False),
    "lies: not enabled": _lie(enabled=False),
    "lies: a hold": _lie(held=True),
    "hangs": SimulatedStation.hang,
    "drops": SimulatedStation.drop,
    "answers HTML": SimulatedStation.answer_html,
    "repeats itself": SimulatedStation.freeze,
    "clock ahead": lambda station: station.set_clock(3600.0),
    "clock behind": lambda station: station.set_clock(-3600.0),
}
"""A lie about everything at once cannot be seen by anybody; each of these leaves a trace."""

PHASES = {
    JobType.PLUG_IN: (JobPhase.ALIGNING, JobPhase.INSERTING, JobPhase.PLUGGED),
    JobType.UNPLUG: (JobPhase.PREFLIGHT, JobPhase.RELEASING, JobPhase.WITHDRAWING),
}
LASTS_S = {
    JobPhase.ALIGNING: 2.0,
    JobPhase.INSERTING: 5.5,
    JobPhase.PLUGGED: 1.0,
    JobPhase.PREFLIGHT: 0.5,
    JobPhase.RELEASING: 2.0,
    JobPhase.WITHDRAWING: 5.0,
}
"""About how long a phase takes: attacks are spread over it."""

WORST_S = {JobPhase.INSERTING: (4.5, 6.0), JobPhase.WITHDRAWING: (0.1, 1.0)}
"""When the plug moves with the pilot contact made: every other attack comes here."""


@dataclass(frozen=True, slots=True)
class Attack:
    """One attack on one job.

    Attributes:
        phase: It begins with this phase.
        will: What the rival does.
        mischief: What the station does besides; a name in ``MISCHIEF``.
        mischief_after_s: When that begins.
        mischief_for_s: How long it lasts.
    """

    phase: JobPhase
    will: Will
    mischief: str
    mischief_after_s: float
    mischief_for_s: float


def draw_attack(rng: random.Random, job_type: JobType) -> Attack:
    """An attack on a job of this type."""
    if rng.random() < 0.5:
        phase = next(phase for phase in PHASES[job_type] if phase in WORST_S)
        after_s = rng.uniform(*WORST_S[phase])
    else:
        phase = rng.choice(PHASES[job_type])
        after_s = rng.uniform(0.0, LASTS_S[phase])
    lasts_s = LASTS_S[phase]
    return Attack(
        phase=phase,
        will=Will(
            after_s=after_s,
            again_after_s=rng.choice([None, rng.uniform(0.01, 2.0)]),
            breaks_holds=rng.random() < 0.7,
        ),
        mischief=rng.choice(["nothing"] * 8 + [name for name in MISCHIEF if name != "nothing"]),
        mischief_after_s=rng.uniform(0.0, lasts_s),
        mischief_for_s=rng.uniform(0.05, 4.0),
    )


def draw_garage(rng: random.Random) -> SimulationParameters:
    """A garage whose contactor may be quicker than any real one, and whose car may not lock."""
    numbers = SimulationParameters()
    quickest_s = rng.choice([0.02, 0.1, 0.5])
    station = numbers.station.model_copy(
        update={
            "holds": rng.random() < 0.7,
            "car_locks": rng.random() < 0.3,
            "contactor_closes_s": (quickest_s, quickest_s + 0.5),
            "stop_reaction_s": rng.uniform(0.1, 2.0),
            "answer_s": rng.choice([0.005, 0.03, 0.1]),
        }
    )
    return numbers.model_copy(update={"station": station})
