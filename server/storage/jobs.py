"""Keeps jobs and their journals."""

from __future__ import annotations

from sqlalchemy import func, select
from sqlalchemy.orm import Session

from server.jobs.model import JobPhase, JobState, JobType
from server.schema.jobs import Job, JobEvent, JobResult, NeedsPerson
from server.schema.problem import Problem
from server.storage.database import Database
from server.storage.spare import is_spare
from server.storage.tables import JobEventRow, JobRow
from server.storage.without_disk import may_begin

PHASE_STARTED = "phase_started"
"""Kind of the event with which a phase begins."""


class JobStore:
    """Jobs, newest first, and what happened in each."""

    def __init__(self, database: Database) -> None:
        self._database = database

    async def add(self, job: Job, *, key: str | None, digest: str | None) -> None:
        """Keep a new job together with the request it came from.

        Raises:
            StorageError: it cannot be kept; of those that begin without a disk there are few.
        """

        def work(session: Session) -> None:
            self._refuse_without_disk(session, job, None)
            row = _new_row(job)
            row.idempotency_key, row.request_digest = key, digest
            session.add(row)

        await self._database.run(work)

    async def save(self, job: Job, event: JobEvent | None = None) -> None:
        """Keep a job's new state, and the event that led to it, in one transaction.

        Raises:
            StorageError: it cannot be kept, and the phase must not begin without that.
        """

        def work(session: Session) -> None:
            row = self._row(session, job)
            if event is not None and event.kind == PHASE_STARTED:
                self._refuse_without_disk(session, job, JobPhase(row.phase))
            _write(row, job)
            if event is not None:
                session.add(_event_row(job.id, event))

        await self._database.run(work)

    async def get(self, job_id: str) -> Job | None:
        """One job, or None."""

        def work(session: Session) -> Job | None:
            row = session.get(JobRow, job_id)
            return None if row is None else _read(row)

        return await self._database.run(work)

    async def by_key(self, key: str) -> tuple[Job, str | None] | None:
        """The job that came with an Idempotency-Key, and the digest of its request."""

        def work(session: Session) -> tuple[Job, str | None] | None:
            row = session.scalar(select(JobRow).where(JobRow.idempotency_key == key))
            return None if row is None else (_read(row), row.request_digest)

        return await self._database.run(work)

    async def page(self, *, before: str | None, limit: int) -> list[Job]:
        """Up to ``limit`` jobs older than ``before`` (ids sort by time), newest first."""

        def work(session: Session) -> list[Job]:
            query = select(JobRow).order_by(JobRow.id.desc()).limit(limit)
            if before is not None:
                query = query.where(JobRow.id < before)
            return [_read(row) for row in session.scalars(query)]

        return await self._database.run(work)

    async def unfinished(self) -> list[Job]:
        """Jobs that had not ended when PlugPilot last stopped, oldest first."""

        def work(session: Session) -> list[Job]:
            open_states = [state.value for state in JobState if not state.ended]
            query = select(JobRow).where(JobRow.state.in_(open_states)).order_by(JobRow.id)
            return [_read(row) for row in session.scalars(query)]

        return await self._database.run(work)

    async def succeeded(self, limit: int) -> list[Job]:
        """The newest jobs that have done what they were asked for, newest first."""

        def work(session: Session) -> list[Job]:
            query = (
                select(JobRow)
                .where(JobRow.state == JobState.SUCCEEDED.value)
                .order_by(JobRow.id.desc())
                .limit(limit)
            )
            return [_read(row) for row in session.scalars(query)]

        return await self._database.run(work)

    async def events(self, job_id: str) -> list[JobEvent]:
        """The journal of one job, oldest first."""

        def work(session: Session) -> list[JobEvent]:
            query = (
                select(JobEventRow)
                .where(JobEventRow.job_id == job_id)
                .order_by(JobEventRow.sequence)
            )
            return [
                JobEvent(
                    sequence=row.sequence,
                    at=row.at,
                    kind=row.kind,
                    phase=JobPhase(row.phase),
                    message=row.message,
                    data=row.data,
                )
                for row in session.scalars(query)
            ]

        return await self._database.run(work)

    async def last_sequence(self, job_id: str) -> int:
        """Number of the newest event of a job; 0 without one."""

        def work(session: Session) -> int:
            query = select(func.max(JobEventRow.sequence)).where(JobEventRow.job_id == job_id)
            return session.scalar(query) or 0

        return await self._database.run(work)

    def _row(self, session: Session, job: Job) -> JobRow:
        """The row of a known job. Memory that stands in for the disk may have to make it."""
        if not is_spare(session):
            return session.get_one(JobRow, job.id)
        row = session.get(JobRow, job.id)
        if row is None:
            row = _new_row(job)
            session.add(row)
        return row

    def _refuse_without_disk(self, session: Session, job: Job, before: JobPhase | None) -> None:
        trouble = self._database.problem
        if trouble is not None and is_spare(session) and not may_begin(job, before):
            raise trouble


def _new_row(job: Job) -> JobRow:
    row = JobRow(
        id=job.id,
        type=job.type.value,
        vehicle_id=job.vehicle_id,
        target_energy_wh=job.target_energy_wh,
        not_before=job.not_before,
        unplug_by=job.unplug_by,
        created_at=job.created_at,
    )
    _write(row, job)
    return row


def _write(row: JobRow, job: Job) -> None:
    row.state = job.state.value
    row.phase = job.phase.value
    row.updated_at = job.updated_at
    row.phase_started_at = job.phase_started_at
    row.cancel_requested = job.cancel_requested
    row.paused = job.paused
    row.needs_person = job.needs_person.model_dump(mode="json") if job.needs_person else None
    row.result = job.result.model_dump(mode="json")
    row.error = job.error.model_dump(mode="json") if job.error else None


def _read(row: JobRow) -> Job:
    return Job(
        id=row.id,
        type=JobType(row.type),
        state=JobState(row.state),
        phase=JobPhase(row.phase),
        vehicle_id=row.vehicle_id,
        target_energy_wh=row.target_energy_wh,
        not_before=row.not_before,
        unplug_by=row.unplug_by,
        created_at=row.created_at,
        updated_at=row.updated_at,
        phase_started_at=row.phase_started_at,
        cancel_requested=row.cancel_requested,
        paused=row.paused,
        needs_person=NeedsPerson.model_validate(row.needs_person) if row.needs_person else None,
        result=JobResult.model_validate(row.result),
        error=Problem.model_validate(row.error) if row.error else None,
    )


def _event_row(job_id: str, event: JobEvent) -> JobEventRow:
    return JobEventRow(
        job_id=job_id,
        sequence=event.sequence,
        at=event.at,
        kind=event.kind,
        phase=event.phase.value,
        message=event.message,
        data=event.data,
    )
