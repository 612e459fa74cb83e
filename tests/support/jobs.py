"""A job as it is written down, for tests that need one and run none."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from server.jobs.model import JobPhase, JobState, JobType
from server.schema.jobs import Job, JobResult


def job_of(now: datetime, **changes: Any) -> Job:  # noqa: ANN401 - values of a job
    """A charge that has just begun.

    Args:
        now: When it was accepted, and last changed.
        changes: Fields that are different.
    """
    job = Job(
        id="01956b1e-8c00-7000-8000-000000000001",
        type=JobType.CHARGE,
        state=JobState.RUNNING,
        phase=JobPhase.PREFLIGHT,
        vehicle_id="zoe",
        target_energy_wh=None,
        created_at=now,
        updated_at=now,
        phase_started_at=now,
        cancel_requested=False,
        result=JobResult(),
        error=None,
    )
    return job.model_copy(update=changes)
