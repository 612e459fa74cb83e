"""Calibrations: every version, which one is in force, and how that changes."""

from __future__ import annotations

import asyncio
from typing import Annotated

from fastapi import APIRouter, Path, Query, Request, Response

from server.api.dependencies import ServicesDep
from server.api.gate import caller_of
from server.api.pagination import Cursor, Limit, id_in, split_page
from server.api.problems import problem_responses
from server.calibration.routines.check_record import with_verdict
from server.calibration.routines.described import ROUTINES
from server.calibration.versions.errors import CheckNotFoundError
from server.calibration.versions.new_calibration import NewCalibration
from server.calibration.view import calibration_view
from server.schema.accuracy import AccuracyCheck, AccuracyCheckPage
from server.schema.calibrations import (
    Activation,
    Calibration,
    CalibrationDetail,
    CalibrationEntry,
    CalibrationKind,
    CalibrationPage,
    RollBack,
)
from server.schema.drift import DriftReport
from server.schema.routines import (
    CalibrationNow,
    Routine,
    RoutineAnswer,
    RoutineList,
    RoutineRequest,
)
from server.storage.calibrations import WHOLE_ROBOT

router = APIRouter(prefix="/calibrations", tags=["calibration"])

CalibrationId = Annotated[str, Path(max_length=64, description="As in the list of calibrations")]
CheckId = Annotated[str, Path(max_length=64, description="As in the list of checks")]
_PDF = "application/pdf"
_FILE = {"type": "string", "format": "binary"}
KindFilter = Annotated[CalibrationKind | None, Query(description="Only of this kind")]


@router.get(
    "",
    operation_id="listCalibrations",
    summary="List calibrations",
    responses=problem_responses(400),
)
async def list_calibrations(
    services: ServicesDep, kind: KindFilter = None, cursor: Cursor = None, limit: Limit = 20
) -> CalibrationPage:
    """All versions that were ever made, newest first."""
    found = await services.calibrations.page(kind=kind, before=id_in(cursor), limit=limit)
    page, last = split_page(found, limit)
    return CalibrationPage(items=page, next_cursor=last.id if last else None)


@router.post(
    "",
    status_code=201,
    operation_id="keepCalibration",
    summary="Keep numbers from elsewhere",
    responses=problem_responses(409, 422),
)
async def keep_calibration(
    entry: CalibrationEntry, request: Request, response: Response, services: ServicesDep
) -> Calibration:
    """Keep numbers that were found elsewhere, such as in a camera file, as a new version.

    It is not in force, and nobody has measured what it misses.
    """
    new = NewCalibration(entry.values, caller_of(request).name, entry.source)
    kept = await services.calibrations.keep(new)
    response.headers["Location"] = f"/api/v1/calibrations/{kept.id}"
    return kept


@router.get(
    "/checks",
    operation_id="listAccuracyChecks",
    summary="List nine-point checks",
    responses=problem_responses(400),
)
async def list_checks(
    services: ServicesDep, cursor: Cursor = None, limit: Limit = 20
) -> AccuracyCheckPage:
    """How exactly the robot went where it was sent, newest first."""
    found = await services.accuracy_checks.page(before=id_in(cursor), limit=limit)
    page, last = split_page(found, limit)
    return AccuracyCheckPage(
        items=[with_verdict(one) for one in page], next_cursor=last.id if last else None
    )


@router.get(
    "/checks/{check_id}/report.pdf",
    operation_id="getAccuracyReport",
    summary="Download the report of a check",
    response_class=Response,
    responses={
        200: {"description": "The report", "content": {_PDF: {"schema": _FILE}}},
        **problem_responses(404),
    },
)
async def get_report(check_id: CheckId, services: ServicesDep) -> Response:
    """A nine-point check on paper: AP, RP and vAP of each place, in a table and in pictures."""
    check = await services.accuracy_checks.get(check_id)
    if check is None:
        raise CheckNotFoundError(f"There is no check {check_id}.")
    calibration = None
    if check.calibration_id is not None:
        calibration = await services.calibrations.get(check.calibration_id)
    paper = await asyncio.to_thread(_report, check, calibration)
    name = f"plugpilot-check-{check.made_at:%Y%m%d-%H%M%S}.pdf"
    return Response(
        paper,
        media_type=_PDF,
        headers={
            "Content-Disposition": f'attachment; filename="{name}"',
            "Cache-Control": "private, no-cache",
            "X-Content-Type-Options": "nosniff",
        },
    )


def _report(check: AccuracyCheck, calibration: Calibration | None) -> bytes:
    # Loaded here alone: what draws takes a second and 40 MB that nobody else needs.
    from server.calibration.report.accuracy_report import accuracy_report  # noqa: PLC0415

    return accuracy_report(check, calibration)


@router.get("/now", operation_id="getCalibrationNow", summary="Read what is in force")
async def get_now(services: ServicesDep) -> CalibrationNow:
    """The version of each kind that counts now, and the routine under way or the last one."""
    return calibration_view(services.calibrations, services.measuring)


@router.get("/drift", operation_id="getDrift", summary="Read what jobs have shown")
async def get_drift(services: ServicesDep) -> DriftReport:
    """How the belts have changed, what good insertions feel like, and what wears.

    Every successful job adds to it. Small changes of the belts are put in force by themselves, as
    versions whose evidence says ``drift``; whoever rolls one back is obeyed.
    """
    return services.self_calibration.report


@router.get("/routines", operation_id="listRoutines", summary="List the routines")
async def list_routines() -> RoutineList:
    """What can be measured, in the order in which a new robot wants it."""
    return RoutineList(routines=list(ROUTINES))


@router.post(
    "/routine",
    status_code=202,
    operation_id="beginCalibration",
    summary="Begin a routine",
    responses=problem_responses(404, 409, 422, 503),
)
async def begin_routine(wanted: RoutineRequest, request: Request, services: ServicesDep) -> Routine:
    """Measure the robot or a part of it, check it, or teach a socket; ``listRoutines`` says what.

    Answers at once. What comes of it is a new version that nobody uses yet. A routine that was
    interrupted, by a stop or a lost label, keeps what it has and can be resumed.
    """
    return await services.routines.begin(wanted, caller_of(request).name)


@router.post(
    "/routine/confirm",
    operation_id="confirmCalibration",
    summary="Answer the routine",
    responses=problem_responses(409, 422),
)
async def confirm_routine(answer: RoutineAnswer, services: ServicesDep) -> Routine:
    """Confirm that what it asks for is done or, where it asks for one, give a number."""
    return services.routines.confirm(answer)


@router.post(
    "/routine/resume",
    operation_id="resumeCalibration",
    summary="Go on with the routine",
    responses=problem_responses(409, 503),
)
async def resume_routine(services: ServicesDep) -> Routine:
    """Go on where the routine was interrupted."""
    return await services.routines.resume()


@router.post(
    "/routine/cancel",
    operation_id="cancelCalibration",
    summary="End the routine",
    responses=problem_responses(409),
)
async def cancel_routine(services: ServicesDep) -> Routine:
    """The robot comes to rest, and nothing is kept."""
    return await services.routines.cancel()


@router.post(
    "/roll-back",
    operation_id="rollBackCalibration",
    summary="Go back to the one before",
    responses=problem_responses(409, 422, 503),
)
async def roll_back(wanted: RollBack, request: Request, services: ServicesDep) -> CalibrationNow:
    """Put in force what was in force before: an older version, or what the configuration says.

    Refused while a job, or somebody else, uses the robot, and while the plug is in a socket.
    """
    await services.calibrations.roll_back(
        wanted.kind, by=caller_of(request).name, subject=wanted.vehicle_id or WHOLE_ROBOT
    )
    return calibration_view(services.calibrations, services.measuring)


@router.get(
    "/{calibration_id}",
    operation_id="getCalibration",
    summary="Read a calibration",
    responses=problem_responses(404),
)
async def get_calibration(
    calibration_id: CalibrationId, services: ServicesDep
) -> CalibrationDetail:
    """One version with what it rests on."""
    return await services.calibrations.get(calibration_id)


@router.post(
    "/{calibration_id}/activation",
    operation_id="activateCalibration",
    summary="Put a calibration in force",
    responses=problem_responses(404, 409, 422, 503),
)
async def activate(
    calibration_id: CalibrationId, activation: Activation, request: Request, services: ServicesDep
) -> Calibration:
    """Put a version in force. Nothing moves by it.

    One that is worse than the one in force is refused with how much worse it is, unless that is
    accepted. Refused while a job, or somebody else, uses the robot, and while the plug is in a
    socket.
    """
    return await services.calibrations.activate(
        calibration_id, by=caller_of(request).name, accept_worse=activation.accept_worse
    )
