"""How long each phase usually takes on this robot, learnt from the journals of its jobs."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator
from statistics import median
from typing import NamedTuple

from server.config.phase_times import PhaseTimeSettings
from server.jobs.model import JobPhase, JobState
from server.jobs.outlook.progress import Progress
from server.schema.jobs import JobEvent
from server.storage.jobs import PHASE_STARTED

LATEST = 20
"""So many of each count: an old robot, or a car that parks elsewhere now, is not what it was."""


class TimedPhase(NamedTuple):
    """A phase whose length says something about its next one.

    Attributes:
        phase: Which one.
        homing: With finding the zero of each axis, which takes a hundred times as long as the rest
            of a preflight.
    """

    phase: JobPhase
    homing: bool = False


class PhaseTimes:
    """The median over the newest of each phase. All times are the robot's own [s].

    Args:
        settings: What counts until this robot has done a phase itself.
    """

    def __init__(self, settings: PhaseTimeSettings) -> None:
        self._unlearnt = {
            TimedPhase(JobPhase.PREFLIGHT): settings.preflight_s,
            TimedPhase(JobPhase.PREFLIGHT, homing=True): settings.preflight_with_homing_s,
            TimedPhase(JobPhase.LOCATING): settings.locating_s,
            TimedPhase(JobPhase.ALIGNING): settings.aligning_s,
            TimedPhase(JobPhase.INSERTING): settings.inserting_s,
            TimedPhase(JobPhase.RELEASING): settings.releasing_s,
            TimedPhase(JobPhase.WITHDRAWING): settings.withdrawing_s,
            TimedPhase(JobPhase.PARKING): settings.parking_s,
        }
        self._learnt: dict[TimedPhase, deque[float]] = {}

    def learn(self, journal: Iterable[JobEvent]) -> None:
        """Take in the whole journal of a job that has succeeded; newer jobs come later."""
        for phase, duration_s in durations(journal):
            if phase in self._unlearnt:
                self._learnt.setdefault(phase, deque(maxlen=LATEST)).append(duration_s)

    def usual_s(self, phase: TimedPhase) -> float:
        """How long such a phase takes as a rule.

        Raises:
            KeyError: that is up to the car.
        """
        learnt = self._learnt.get(phase)
        return median(learnt) if learnt else self._unlearnt[phase]


def durations(journal: Iterable[JobEvent]) -> Iterator[tuple[TimedPhase, float]]:
    """How long the phases of a job took that ran through without an interruption [s].

    Args:
        journal: Oldest entry first.
    """
    progress = Progress()
    for event in journal:
        stage = progress.stage
        if stage is not None and event.kind in {PHASE_STARTED, JobState.SUCCEEDED.value}:
            lasted_s = (event.at - stage.began_at).total_seconds() * stage.clock_speed
            # A clock that was set meanwhile may even have gone back.
            yield TimedPhase(stage.phase, stage.homing), max(0.0, lasted_s)
        progress = progress.after(event)
