"""Recordings of jobs: to download, and to watch in 3D."""

from __future__ import annotations

from pathlib import Path as FilePath
from typing import Annotated, Any

from fastapi import APIRouter, Path
from fastapi.responses import FileResponse

from server.api.dependencies import ServicesDep
from server.api.problems import problem_responses
from server.jobs.errors import JobNotFoundError
from server.schema.jobs import Job, Playback
from server.services import Services

router = APIRouter(prefix="/jobs", tags=["jobs"])

JobId = Annotated[str, Path(max_length=64, description="As in the job's Location")]

_BINARY = "application/octet-stream"
_HEADERS = {"Cache-Control": "private, no-cache", "X-Content-Type-Options": "nosniff"}
_FILE: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "The file; parts of it may be asked for (Range)",
        "content": {_BINARY: {"schema": {"type": "string", "format": "binary"}}},
    },
    206: {"description": "A part of the file"},
}


@router.get(
    "/{job_id}/recording",
    operation_id="getJobRecording",
    summary="Download a recording",
    response_class=FileResponse,
    responses={**_FILE, **problem_responses(404, 409)},
)
async def get_recording(job_id: JobId, services: ServicesDep) -> FileResponse:
    """What was recorded of the job, as an MCAP file. Foxglove opens it."""
    job = await _job(services, job_id)
    name = f"plugpilot-{job.created_at:%Y%m%d-%H%M%S}-{job.type.value}.mcap"
    return _file(services.recordings.path(job.id), name)


@router.get(
    "/{job_id}/playback",
    operation_id="getJobPlayback",
    summary="Make a playback ready",
    responses=problem_responses(404, 409, 500),
)
async def get_playback(job_id: JobId, services: ServicesDep) -> Playback:
    """Make the recording ready to be watched in 3D, and say what happens when.

    Then open ``/twin/?playbackPath=/api/v1/jobs/{job_id}/playback.viser``. Making it takes some
    seconds the first time.
    """
    job = await _job(services, job_id)
    return await services.playbacks.marks(job.id)


@router.get(
    "/{job_id}/playback.viser",
    operation_id="getJobPlaybackFile",
    summary="Download a playback",
    response_class=FileResponse,
    responses={**_FILE, **problem_responses(404, 409, 500)},
)
async def get_playback_file(job_id: JobId, services: ServicesDep) -> FileResponse:
    """The playback as the 3D picture reads it."""
    job = await _job(services, job_id)
    return _file(await services.playbacks.path(job.id), f"{job.id}.viser")


async def _job(services: Services, job_id: str) -> Job:
    job = await services.jobs.get(job_id)
    if job is None:
        raise JobNotFoundError(f"There is no job {job_id}.", job_id=job_id)
    return job


def _file(path: FilePath, name: str) -> FileResponse:
    return FileResponse(path, media_type=_BINARY, filename=name, headers=_HEADERS)
