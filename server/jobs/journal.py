"""The journal of one job: every step is on disk before the robot takes it."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable
from datetime import datetime
from typing import Any

from server.errors import PlugPilotError
from server.jobs.history import History, history_of
from server.jobs.model import JobPhase, JobState
from server.jobs.turning_back import TurnBack
from server.schema.jobs import Job, JobEvent, NeedsPerson
from server.schema.problem import Problem, problem_from
from server.storage.jobs import JobStore
from server.timing import Calendar

_log = logging.getLogger(__name__)

OnEntry = Callable[[Job, JobEvent | None], None]


class Journal:
    """Keeps one job's state and what happened in it.

    Args:
        job: The job as it was accepted.
        store: Where it is kept.
        calendar: Dates of the entries.
        changed: Called with the job and the newest entry after every change.
        sequence: Number of the newest entry that is there already.
    """

    def __init__(
        self,
        job: Job,
        store: JobStore,
        calendar: Calendar,
        changed: OnEntry,
        *,
        sequence: int = 0,
    ) -> None:
        self.job = job
        self._store = store
        self._calendar = calendar
        self._changed = changed
        self._sequence = sequence

    async def begin(self, phase: JobPhase, message: str) -> None:
        """Enter a phase. Returns when that is on disk, so do it before the first motion."""
        now, speed = self._calendar.now(), self._calendar.speed
        await self._record(
            "phase_started",
            message,
            # What the dates of a simulated garage say of the robot's time depends on it.
            {} if speed == 1.0 else {"clock_speed": speed},
            phase=phase,
            state=JobState.RUNNING,
            phase_started_at=now,
        )

    async def note(self, kind: str, message: str, **data: Any) -> None:  # noqa: ANN401 - JSON
        """Write down something that happened in the phase."""
        await self._record(kind, message, data)

    async def measured(self, kind: str, message: str, **results: float | None) -> None:
        """Write down results of the job."""
        result = self.job.result.model_copy(update=results)
        await self._record(kind, message, dict(results), result=result)

    async def want_cancel(self) -> None:
        """Somebody asked to cancel."""
        await self._record(
            "cancel_requested", "Somebody asked to cancel.", {}, cancel_requested=True
        )

    async def pause(self, message: str) -> None:
        """Somebody paused the job, and it has come to rest."""
        await self._record("paused", message, {}, paused=True)

    async def unpause(self) -> None:
        """Somebody resumed a paused job."""
        await self._record("unpaused", "Somebody resumed the job.", {}, paused=False)

    async def ask(self, needs: NeedsPerson) -> None:
        """A person must decide how the job goes on."""
        await self._record(
            "person_needed", needs.sentence, {"code": needs.code}, needs_person=needs
        )

    async def answered(self, message: str) -> None:
        """What the job asked about is settled."""
        await self._record("person_answered", message, {}, needs_person=None)

    async def turn_back(self, turn: TurnBack) -> None:
        """The job ends early. Returns when that is on disk, so do it before the way back."""
        await self._record(
            "turned_back",
            turn.problem.detail,
            turn.as_data(),
            paused=False,
            needs_person=None,
        )

    async def resumed(self, phase: JobPhase, message: str, *, after_restart: bool) -> None:
        """The job goes on after it was interrupted in a phase."""
        data = {"phase": phase.value, "after_restart": after_restart}
        await self._record("resumed", message, data, state=JobState.RUNNING)

    async def history(self) -> History:
        """What the whole journal says, entries of earlier runs of PlugPilot included."""
        return history_of(await self._store.events(self.job.id))

    async def charged(self, energy_wh: float, **cost: float | str | datetime) -> None:
        """Keep how much energy has flowed so far, and its cost; no entry of its own."""
        result = self.job.result.model_copy(update={"energy_wh": round(energy_wh, 1), **cost})
        self.job = self.job.model_copy(
            update={"result": result, "updated_at": self._calendar.now()}
        )
        await asyncio.shield(self._store.save(self.job))
        self._changed(self.job, None)

    async def end(
        self, state: JobState, message: str, error: PlugPilotError | Problem | None = None
    ) -> None:
        """The job is over."""
        problem = problem_from(error) if isinstance(error, PlugPilotError) else error
        data = {"code": problem.code, **problem.context} if problem else {}
        await self._record(
            state.value,
            message,
            data,
            state=state,
            error=problem,
            paused=False,
            needs_person=None,
        )

    def give_up(self, error: PlugPilotError) -> None:
        """The job is over, and that cannot be written; the next start writes it."""
        self.job = self.job.model_copy(
            update={"state": JobState.FAILED, "error": problem_from(error)}
        )
        self._changed(self.job, None)

    async def _record(
        self,
        kind: str,
        message: str,
        data: dict[str, Any],
        **changes: Any,  # noqa: ANN401 - fields of Job
    ) -> None:
        now = self._calendar.now()
        job = self.job.model_copy(update={**changes, "updated_at": now})
        self._sequence += 1
        event = JobEvent(
            sequence=self._sequence,
            at=now,
            kind=kind,
            phase=job.phase,
            message=message[:500],
            data=data,
        )
        self.job = job
        # A cancelled caller must not leave the journal behind the truth.
        await asyncio.shield(self._store.save(job, event))
        self._changed(job, event)
        _log.info("job %s, %s: %s", job.id, job.phase.value, message)
