"""Pictures of the camera on the robot."""

from __future__ import annotations

import contextlib
from collections.abc import AsyncGenerator

from fastapi import APIRouter, Response
from fastapi.responses import StreamingResponse

from drivers.camera import CameraError
from server.api.dependencies import ServicesDep
from server.api.errors import CameraFailedError
from server.api.problems import problem_responses
from server.live.camera_feed import CameraFeed

router = APIRouter(prefix="/camera", tags=["camera"])

BOUNDARY = "frame"
_NOT_STORED = {"Cache-Control": "no-store"}
_JPEG = {"content": {"image/jpeg": {}}, "description": "The picture"}
_STREAM = {"content": {"multipart/x-mixed-replace": {}}, "description": "Pictures"}


@router.get(
    "/snapshot.jpg",
    operation_id="getCameraSnapshot",
    summary="Take a picture",
    response_class=Response,
    responses={200: _JPEG, **problem_responses(503)},
)
async def snapshot(services: ServicesDep) -> Response:
    """A new picture at full size."""
    try:
        picture = await services.camera.snapshot()
    except CameraError as error:
        raise CameraFailedError(str(error)) from error
    return Response(picture, media_type="image/jpeg", headers=_NOT_STORED)


@router.get(
    "/stream.mjpg",
    operation_id="streamCamera",
    summary="Follow the camera",
    response_class=StreamingResponse,
    responses={200: _STREAM, **problem_responses(503)},
)
async def stream(services: ServicesDep) -> StreamingResponse:
    """Pictures as they come, newest only (multipart/x-mixed-replace)."""
    pictures = _parts(services.camera)
    try:
        first = await anext(pictures)
    except CameraError as error:
        raise CameraFailedError(str(error)) from error
    return StreamingResponse(
        _from(first, pictures),
        media_type=f"multipart/x-mixed-replace; boundary={BOUNDARY}",
        headers=_NOT_STORED,
    )


async def _parts(feed: CameraFeed) -> AsyncGenerator[bytes]:
    async for picture in feed.stream():
        yield (
            b"--%s\r\nContent-Type: image/jpeg\r\nContent-Length: %d\r\n\r\n%s\r\n"
            % (BOUNDARY.encode(), len(picture), picture)
        )


async def _from(first: bytes, rest: AsyncGenerator[bytes]) -> AsyncGenerator[bytes]:
    # Closed by hand: a viewer who has gone must not keep the camera at work until the garbage
    # collector finds the generator.
    async with contextlib.aclosing(rest):
        yield first
        try:
            async for part in rest:
                yield part
        except CameraError:
            return  # the stream ends, which a browser shows as a broken picture
