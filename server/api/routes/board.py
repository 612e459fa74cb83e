"""What the camera routine sees: the board in somebody's hands, picture by picture."""

from __future__ import annotations

import asyncio
import tempfile
from pathlib import Path
from typing import Annotated

from fastapi import APIRouter, Query, Response
from fastapi import Path as InPath

from server.api.dependencies import ServicesDep
from server.api.errors import NotFoundError
from server.api.problems import problem_responses
from server.labels.board_layout import BoardLayout
from server.schema.board import BoardLook

router = APIRouter(prefix="/calibrations", tags=["calibration"])

_JPEG = {"content": {"image/jpeg": {}}, "description": "The picture"}
_PDF = {
    "content": {"application/pdf": {"schema": {"type": "string", "format": "binary"}}},
    "description": "The sheet",
}
_LARGEST = 2**53 - 1


@router.get(
    "/board.pdf",
    operation_id="getBoardSheet",
    summary="Download the board",
    response_class=Response,
    responses={200: _PDF},
)
async def board_sheet() -> Response:
    """The board by which the camera is calibrated, on A4 with a ruler to check the print."""
    paper = await asyncio.to_thread(_sheet)
    return Response(
        paper,
        media_type="application/pdf",
        headers={
            "Content-Disposition": 'attachment; filename="plugpilot-board.pdf"',
            "X-Content-Type-Options": "nosniff",
        },
    )


def _sheet() -> bytes:
    # Loaded here alone: what draws takes a second and 40 MB that nobody else needs.
    from server.labels.board_sheet import draw_board_sheet  # noqa: PLC0415

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "board.pdf"
        draw_board_sheet(BoardLayout()).save(path, "PlugPilot camera board")
        return path.read_bytes()


@router.get(
    "/routine/board",
    operation_id="watchBoard",
    summary="Watch the board",
    responses=problem_responses(409),
)
async def watch_board(
    services: ServicesDep,
    after: Annotated[
        int, Query(ge=0, le=_LARGEST, description="Number of the one that is known already")
    ] = 0,
) -> BoardLook:
    """The newest picture of the board and what to do next; waits for one that is not known.

    Only while the camera is calibrated.
    """
    return await services.routines.board.other_than(after)


@router.get(
    "/routine/board/{sequence}.jpg",
    operation_id="getBoardPicture",
    summary="Read a picture of the board",
    response_class=Response,
    responses={200: _JPEG, **problem_responses(404)},
)
async def board_picture(
    services: ServicesDep, sequence: Annotated[int, InPath(ge=1, le=_LARGEST)]
) -> Response:
    """The picture of a look; only the newest few are kept."""
    jpeg = services.routines.board.picture(sequence)
    if jpeg is None:
        raise NotFoundError(f"The picture {sequence} is not kept any more.")
    return Response(jpeg, media_type="image/jpeg", headers={"Cache-Control": "private, no-store"})
