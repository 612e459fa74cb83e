"""For each status a problem that ends with it."""

from __future__ import annotations

from http import HTTPStatus
from typing import Any

from server.access.errors import ForbiddenError, NotPairedError, TooManyAttemptsError
from server.api.errors import (
    BodyTooLargeError,
    BodyTooSlowError,
    InvalidRequestError,
    MalformedJsonError,
    PreconditionFailedError,
    PreconditionRequiredError,
)
from server.control.errors import ControlBusyError, StationUnsafeError
from server.errors import InternalError, PlugPilotError
from server.jobs.errors import JobNotFoundError
from server.schema.problem import problem_from
from server.storage.errors import StorageError

_ERRORS: tuple[PlugPilotError, ...] = (
    MalformedJsonError("The body is not JSON: Expecting value."),
    NotPairedError("The robot does not know who asks."),
    ForbiddenError("Ben may not do that."),
    JobNotFoundError("There is no job 42.", job_id="42"),
    BodyTooSlowError("POST /api/v1/jobs: the body did not arrive in time."),
    ControlBusyError(
        "Charging job has had control since 18:02:11 UTC.", holder="Charging job", holder_kind="job"
    ),
    PreconditionFailedError('If-Match names "8c2f0a3be1d94f66", which is not there now.'),
    BodyTooLargeError("POST /api/v1/jobs: the body is too large."),
    InvalidRequestError(
        "type: Input should be 'charge', 'plug_in' or 'unplug'.",
        fields=[{"field": "type", "problem": "Input should be 'charge', 'plug_in' or 'unplug'"}],
    ),
    PreconditionRequiredError("The header If-Match is missing."),
    TooManyAttemptsError("Try again in 12 s.", wait_s=12),
    InternalError("The request could not be carried out. The log says why."),
    StationUnsafeError("OpenEVSE at http://192.168.1.20 did not answer within 2 s."),
    StorageError("The disk is full."),
)
_BY_STATUS = {error.status: error for error in _ERRORS}


def problem_example(status: str) -> dict[str, Any]:
    """A problem document of a status; of "default" one that is not documented otherwise."""
    number = int(status) if status.isdigit() else HTTPStatus.INTERNAL_SERVER_ERROR
    return problem_from(_BY_STATUS[number]).model_dump(mode="json")
