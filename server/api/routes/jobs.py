"""Jobs."""

from __future__ import annotations

import hashlib
from typing import Annotated
from uuid import UUID

from fastapi import APIRouter, Header, Path, Query, Response

from server.api.dependencies import ServicesDep
from server.api.errors import InvalidCursorError
from server.api.problems import problem_responses
from server.jobs.errors import JobNotFoundError
from server.schema.jobs import Job, JobEvents, JobPage, JobRequest

router = APIRouter(prefix="/jobs", tags=["jobs"])

JobId = Annotated[str, Path(max_length=64, description="As in the job's Location")]
IdempotencyKey = Annotated[
    str | None,
    Header(
        min_length=1,
        max_length=255,
        description="The same key with the same body gives the same job, however often it is sent",
    ),
]


@router.post(
    "",
    status_code=202,
    operation_id="createJob",
    responses={
        202: {
            "headers": {
                "Location": {"description": "Address of the job", "schema": {"type": "string"}}
            }
        },
        **problem_responses(400, 404, 409, 422, 503),
    },
)
async def create_job(
    request: JobRequest,
    response: Response,
    services: ServicesDep,
    idempotency_key: IdempotencyKey = None,
) -> Job:
    """Accept a job and begin it at once. Watch it over the WebSocket or at its Location."""
    digest = hashlib.sha256(request.model_dump_json().encode()).hexdigest()
    job = await services.runner.create(request, key=idempotency_key, digest=digest)
    response.headers["Location"] = f"/api/v1/jobs/{job.id}"
    return job


@router.get("", operation_id="listJobs", responses=problem_responses(400, 422))
async def list_jobs(
    services: ServicesDep,
    cursor: Annotated[str | None, Query(max_length=64)] = None,
    limit: Annotated[int, Query(ge=1, le=100)] = 20,
) -> JobPage:
    """Jobs, newest first."""
    jobs = await services.jobs.page(before=_job_id_in(cursor), limit=limit + 1)
    more = len(jobs) > limit
    shown = [services.recordings.show(job) for job in jobs[:limit]]
    return JobPage(items=shown, next_cursor=jobs[limit - 1].id if more else None)


@router.get("/{job_id}", operation_id="getJob", responses=problem_responses(404))
async def get_job(job_id: JobId, services: ServicesDep) -> Job:
    """One job."""
    job = await services.jobs.get(job_id)
    if job is None:
        raise JobNotFoundError(f"There is no job {job_id}.", job_id=job_id)
    return services.recordings.show(job)


@router.post(
    "/{job_id}/cancel",
    status_code=202,
    operation_id="cancelJob",
    responses=problem_responses(404, 409),
)
async def cancel_job(job_id: JobId, services: ServicesDep) -> Job:
    """Stop the job and bring plug and robot back to safety."""
    return await services.runner.cancel(job_id)


@router.post(
    "/{job_id}/finish",
    status_code=202,
    operation_id="finishJob",
    responses=problem_responses(404, 409),
)
async def finish_job(job_id: JobId, services: ServicesDep) -> Job:
    """End the charging now; the job goes on to unplug and park."""
    return await services.runner.finish(job_id)


@router.get("/{job_id}/events", operation_id="listJobEvents", responses=problem_responses(404))
async def list_events(job_id: JobId, services: ServicesDep) -> JobEvents:
    """The journal of a job, oldest entry first."""
    if await services.jobs.get(job_id) is None:
        raise JobNotFoundError(f"There is no job {job_id}.", job_id=job_id)
    return JobEvents(items=await services.jobs.events(job_id))


def _job_id_in(cursor: str | None) -> str | None:
    """The cursor in the one spelling that sorts among the ids."""
    if cursor is None:
        return None
    try:
        return str(UUID(cursor))
    except ValueError:
        raise InvalidCursorError(f"{cursor!r} is not a cursor of this list.") from None
