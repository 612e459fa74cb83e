"""Jobs."""

from __future__ import annotations

import hashlib
from typing import Annotated

from fastapi import APIRouter, Header, Path, Query, Response

from server.api.dependencies import ServicesDep
from server.api.pagination import Cursor, Limit, id_in, number_in, split_page
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
    summary="Begin a job",
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
    """Accept a job. Watch it over the WebSocket or at its Location.

    It begins at once, or at `not_before`. While another job runs, one more may wait for it.
    """
    digest = hashlib.sha256(request.model_dump_json().encode()).hexdigest()
    job = await services.runner.create(request, key=idempotency_key, digest=digest)
    response.headers["Location"] = f"/api/v1/jobs/{job.id}"
    return job


@router.get("", operation_id="listJobs", summary="List jobs", responses=problem_responses(400, 422))
async def list_jobs(
    services: ServicesDep,
    cursor: Cursor = None,
    limit: Limit = 20,
) -> JobPage:
    """Jobs, newest first."""
    jobs = await services.jobs.page(before=id_in(cursor), limit=limit + 1)
    page, last = split_page(jobs, limit)
    shown = [services.recordings.show(job) for job in page]
    return JobPage(items=shown, next_cursor=last.id if last else None)


@router.get(
    "/{job_id}", operation_id="getJob", summary="Read a job", responses=problem_responses(404)
)
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
    summary="Cancel a job",
    responses=problem_responses(404, 409),
)
async def cancel_job(job_id: JobId, services: ServicesDep) -> Job:
    """Stop the job and bring plug and robot back to safety."""
    return await services.runner.cancel(job_id)


@router.post(
    "/{job_id}/pause",
    status_code=202,
    operation_id="pauseJob",
    summary="Pause a job",
    responses=problem_responses(404, 409),
)
async def pause_job(job_id: JobId, services: ServicesDep) -> Job:
    """Let the job come to rest: the robot stands still, and a charging car gets no power.

    It keeps control of the robot until it is resumed or cancelled.
    """
    return await services.runner.pause(job_id)


@router.post(
    "/{job_id}/resume",
    status_code=202,
    operation_id="resumeJob",
    summary="Resume a job",
    responses=problem_responses(404, 409),
)
async def resume_job(job_id: JobId, services: ServicesDep) -> Job:
    """Go on with a paused job, or with one that needs a person. What can be seen decides how."""
    return await services.runner.resume(job_id)


@router.post(
    "/{job_id}/finish",
    status_code=202,
    operation_id="finishJob",
    summary="End the charging",
    responses=problem_responses(404, 409),
)
async def finish_job(job_id: JobId, services: ServicesDep) -> Job:
    """End the charging now; the job goes on to unplug and park."""
    return await services.runner.finish(job_id)


@router.get(
    "/{job_id}/events",
    operation_id="listJobEvents",
    summary="Read the journal of a job",
    responses=problem_responses(400, 404),
)
async def list_events(
    job_id: JobId,
    services: ServicesDep,
    cursor: Cursor = None,
    limit: Annotated[int, Query(ge=1, le=1000)] = 500,
) -> JobEvents:
    """Oldest entry first."""
    if await services.jobs.get(job_id) is None:
        raise JobNotFoundError(f"There is no job {job_id}.", job_id=job_id)
    after = number_in(cursor) or 0
    events = [event for event in await services.jobs.events(job_id) if event.sequence > after]
    page, last = split_page(events, limit)
    return JobEvents(items=page, next_cursor=str(last.sequence) if last else None)
