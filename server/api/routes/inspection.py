"""The camera's pictures with what is found in them, for the technician's page."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Path, Query, Response

from drivers.camera import CameraError
from server.api.dependencies import ServicesDep
from server.api.errors import CameraFailedError, NotFoundError
from server.api.problems import problem_responses
from server.schema.inspection import CameraInspection
from server.technician.camera_inspection import InspectionEndedError

router = APIRouter(prefix="/camera/inspection", tags=["camera"])

_JPEG = {"content": {"image/jpeg": {}}, "description": "The picture"}
_LARGEST = 2**53 - 1


@router.get(
    "",
    operation_id="inspectCamera",
    summary="Look closely at a picture",
    responses=problem_responses(503),
)
async def inspect(
    services: ServicesDep,
    after: Annotated[
        int, Query(ge=0, le=_LARGEST, description="Number of the one that is known already")
    ] = 0,
) -> CameraInspection:
    """The newest picture with its label, pose and uncertainty; waits for one that is not known.

    The camera is looked at for as long as somebody asks.
    """
    try:
        return await services.technician.camera.other_than(after)
    except CameraError as error:
        raise CameraFailedError(str(error)) from error
    except InspectionEndedError as error:
        raise CameraFailedError("PlugPilot is ending.") from error


@router.get(
    "/{sequence}.jpg",
    operation_id="getInspectedPicture",
    summary="Read the picture that was looked at",
    response_class=Response,
    responses={200: _JPEG, **problem_responses(404)},
)
async def picture(
    services: ServicesDep, sequence: Annotated[int, Path(ge=1, le=_LARGEST)]
) -> Response:
    """The picture of an inspection; only the newest few are kept."""
    jpeg = services.technician.camera.picture(sequence)
    if jpeg is None:
        raise NotFoundError(f"The picture {sequence} is not kept any more.")
    return Response(jpeg, media_type="image/jpeg", headers={"Cache-Control": "private, no-store"})
