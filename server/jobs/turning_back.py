"""How a job that cannot reach its aim comes to an end, as it is written into the journal.

What made a job turn back is on disk before the way back begins: a restart on that way then ends
the job as it would have ended, and does not begin it anew.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Self

from server.control.errors import (
    ControlLostError,
    EmergencyStoppedError,
    RobotFaultError,
    RobotOfflineError,
    RobotStoppedError,
    StillUnderLoadError,
)
from server.errors import InternalError, PlugPilotError
from server.jobs.errors import CarGoneError, JobCancelledError, StillLockedError
from server.jobs.model import JobPhase, JobType
from server.schema.jobs import Job
from server.schema.problem import Problem, problem_from
from server.storage.errors import StorageError

STOPS = (RobotStoppedError, EmergencyStoppedError)

STAY = (
    RobotFaultError,
    RobotOfflineError,
    ControlLostError,
    CarGoneError,
    StillLockedError,
    StillUnderLoadError,
    StorageError,
    InternalError,
)
"""After these the robot stays where it is: a person must look first."""

WAY_BACK = {JobPhase.RELEASING, JobPhase.WITHDRAWING, JobPhase.PARKING}
"""What goes wrong here is not tried again: a person must look first."""


class Return(StrEnum):
    """What is done with plug and robot before the job ends."""

    COME_BACK = "come_back"  # to the parking place
    END_HOLD = "end_hold"  # an unplugging given up in time: the plug stays, the hold does not
    POWER_OFF = "power_off"  # somebody pressed a stop: nothing moves, and the car gets no power
    STAY = "stay"  # nothing at all


@dataclass(frozen=True, slots=True)
class TurnBack:
    """Why a job ends early, and how.

    Attributes:
        how: What is done first.
        problem: What ended it, as people see it.
    """

    how: Return
    problem: Problem

    @property
    def cancelled(self) -> bool:
        """Somebody wanted it."""
        return self.problem.code == JobCancelledError.code

    @classmethod
    def because(cls, job: Job, cause: PlugPilotError) -> Self:
        """How a job ends that an error has ended where it stands now."""
        return cls(_how(job, cause), problem_from(cause))

    def as_data(self) -> dict[str, Any]:
        """For the journal."""
        return {"how": self.how.value, "problem": self.problem.model_dump(mode="json")}

    @classmethod
    def from_data(cls, data: dict[str, Any]) -> Self:
        """From the journal."""
        return cls(Return(data["how"]), Problem.model_validate(data["problem"]))


def may_be_cancelled(job: Job) -> bool:
    """Whether cancelling a running job changes anything: it is not on its way back already.

    Unplugging can be given up until the plug moves.
    """
    if job.type is JobType.UNPLUG:
        return job.phase in {JobPhase.PREFLIGHT, JobPhase.RELEASING}
    return job.phase not in WAY_BACK


def _how(job: Job, cause: PlugPilotError) -> Return:
    if isinstance(cause, STOPS):
        return Return.POWER_OFF
    if isinstance(cause, STAY):
        return Return.STAY
    if job.type is JobType.UNPLUG:
        return Return.END_HOLD if isinstance(cause, JobCancelledError) else Return.STAY
    if job.phase in WAY_BACK and not isinstance(cause, JobCancelledError):
        return Return.STAY
    return Return.COME_BACK
