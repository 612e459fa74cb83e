"""What ends the phases of a job for the time being, though nothing has gone wrong in them.

JobInterruption
├── JobPaused       somebody paused the job
├── PersonNeeded    a person must decide how the job goes on
└── TurnedBack      a restarted job was on its way back already
"""

from __future__ import annotations

from server.jobs.errors import JobError
from server.jobs.model import PersonChoice
from server.jobs.turning_back import TurnBack
from server.schema.jobs import NeedsPerson


class JobInterruption(JobError):
    """Ends the phases under way; the execution sees to what comes next. Never shown."""

    code = "interruption"


class JobPaused(JobInterruption):
    """Somebody paused the job."""


class PersonNeeded(JobInterruption):
    """A person must decide how the job goes on.

    Args:
        code: Stable name of the reason.
        sentence: The reason, and what to do first.
    """

    def __init__(self, code: str, sentence: str) -> None:
        super().__init__(sentence)
        self.needs = NeedsPerson(code=code, sentence=sentence, choices=list(PersonChoice))


class TurnedBack(JobInterruption):
    """The job was on its way back already, or must turn back now.

    Args:
        turn: Why, and how.
        written: That is in the journal already.
    """

    def __init__(self, turn: TurnBack, *, written: bool) -> None:
        super().__init__(turn.problem.detail)
        self.turn = turn
        self.written = written
