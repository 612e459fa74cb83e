"""Errors of requests.

RequestError
├── MalformedJsonError   the body is not JSON
├── InvalidRequestError  the body or a parameter does not fit
├── NotFoundError        there is nothing at this address
├── MethodError          the address does not take this method
├── InvalidCursorError   the cursor is not one of ours
├── BodyTooLargeError    the body is larger than any that makes sense
├── BodyTooSlowError     the body did not arrive in time
├── PreconditionRequiredError  a change needs If-Match
├── PreconditionFailedError    somebody else has changed it meanwhile
└── CameraFailedError    the camera does not deliver
"""

from __future__ import annotations

from server.errors import PlugPilotError


class RequestError(PlugPilotError):
    """A request that cannot be carried out as it stands."""

    code = "request"
    title = "The request cannot be carried out"
    status = 400


class MalformedJsonError(RequestError):
    """The body is not JSON."""

    code = "malformed_json"
    title = "The body is not JSON"
    remedy = "Send a JSON object with Content-Type: application/json."


class InvalidRequestError(RequestError):
    """The body or a parameter does not fit; the context names each field."""

    code = "invalid_request"
    title = "Some fields do not fit"
    status = 422
    remedy = "Correct the fields that are named and send the request again."


class NotFoundError(RequestError):
    """There is nothing at this address."""

    code = "not_found"
    title = "There is nothing at this address"
    status = 404
    remedy = "See /api/v1/openapi.json for what there is."


class MethodError(RequestError):
    """The address does not take this method."""

    code = "method_not_allowed"
    title = "This address does not take this method"
    status = 405
    remedy = "See /api/v1/openapi.json for what there is."


class InvalidCursorError(RequestError):
    """The cursor is not one of ours."""

    code = "invalid_cursor"
    title = "This cursor is not valid"
    remedy = "Start again without a cursor."


class BodyTooLargeError(RequestError):
    """The body is larger than any that makes sense."""

    code = "body_too_large"
    title = "The body is too large"
    status = 413
    remedy = "Send less; no request needs more than a few kilobytes."


class BodyTooSlowError(RequestError):
    """The body did not arrive in time."""

    code = "body_too_slow"
    title = "The body did not arrive in time"
    status = 408
    remedy = "Check the network, then send the request again."


class PreconditionRequiredError(RequestError):
    """A change needs If-Match."""

    code = "precondition_required"
    title = "Which version is to be changed?"
    status = 428
    remedy = "Read it first, and send its ETag as If-Match."


class PreconditionFailedError(RequestError):
    """Somebody else has changed it meanwhile."""

    code = "precondition_failed"
    title = "Somebody has changed this meanwhile"
    status = 412
    remedy = "Read it again, look what is different, and repeat the change with the new ETag."


class CameraFailedError(RequestError):
    """The camera does not deliver."""

    code = "camera_down"
    title = "The camera does not deliver pictures"
    status = 503
    remedy = "Check the camera's cable, then try again."
