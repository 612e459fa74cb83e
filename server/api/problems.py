"""Errors become problem documents (RFC 9457)."""

from __future__ import annotations

import logging
from http import HTTPStatus
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import Response
from starlette.exceptions import HTTPException
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from server.api.errors import (
    InvalidRequestError,
    MalformedJsonError,
    MethodError,
    NotFoundError,
)
from server.errors import InternalError, PlugPilotError
from server.schema.problem import problem_from

_log = logging.getLogger(__name__)

MEDIA_TYPE = "application/problem+json"


_CONTENT = {MEDIA_TYPE: {"schema": {"$ref": "#/components/schemas/Problem"}}}

ANY_PROBLEM: dict[int | str, dict[str, Any]] = {
    "default": {"description": "Any other problem", "content": _CONTENT}
}
"""What every operation documents: whatever goes wrong, the answer has this form."""


def problem_responses(*statuses: int) -> dict[int | str, dict[str, Any]]:
    """What an operation documents about its own errors."""
    return {
        status: {"description": HTTPStatus(status).phrase, "content": _CONTENT}
        for status in statuses
    }


def install_handlers(app: FastAPI) -> None:
    """Make every error of the application leave it as a problem document."""
    app.add_exception_handler(PlugPilotError, _on_own_error)
    app.add_exception_handler(RequestValidationError, _on_invalid_request)
    app.add_exception_handler(HTTPException, _on_http_error)
    app.add_middleware(_SurpriseMiddleware)


def respond(error: PlugPilotError, headers: dict[str, str] | None = None) -> Response:
    """The HTTP response for an error."""
    return Response(
        problem_from(error).model_dump_json(),
        status_code=error.status,
        media_type=MEDIA_TYPE,
        headers=headers,
    )


# These are coroutines, although they wait for nothing: anything else is called in a thread.


async def _on_own_error(_request: Request, error: Exception) -> Response:
    assert isinstance(error, PlugPilotError)  # noqa: S101 - registered for this type only
    return respond(error)


async def _on_invalid_request(_request: Request, error: Exception) -> Response:
    assert isinstance(error, RequestValidationError)  # noqa: S101 - registered for this type only
    faults = error.errors()
    if any(fault["type"] == "json_invalid" for fault in faults):
        reason = faults[0].get("ctx", {}).get("error", "it cannot be read")
        return respond(MalformedJsonError(f"The body is not JSON: {reason}."))
    fields = [
        {
            "field": ".".join(str(part) for part in fault["loc"][1:]) or str(fault["loc"][0]),
            "problem": fault["msg"],
        }
        for fault in faults
    ]
    sentence = "; ".join(f"{fault['field']}: {fault['problem']}" for fault in fields)
    return respond(InvalidRequestError(f"{sentence}.", fields=fields))


async def _on_http_error(request: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)  # noqa: S101 - registered for this type only
    where = f"{request.method} {request.url.path}"
    headers = dict(error.headers or {})
    match error.status_code:
        case 400:  # FastAPI's word for a body that its JSON reader gave up on
            return respond(MalformedJsonError("The body cannot be read as JSON."), headers)
        case 404:
            return respond(NotFoundError(f"{where}: there is nothing at this address."), headers)
        case 405:
            return respond(MethodError(f"{where}: this method is not allowed here."), headers)
        case status:
            own = PlugPilotError(f"{where}: {error.detail}")
            problem = problem_from(own).model_copy(
                update={"status": status, "title": HTTPStatus(status).phrase}
            )
            return Response(
                problem.model_dump_json(),
                status_code=status,
                media_type=MEDIA_TYPE,
                headers=headers,
            )


class _SurpriseMiddleware:
    """Answers errors that nobody thought of.

    A handler for Exception would not do: Starlette raises the error again after it, and uvicorn
    then cuts the connection before the answer is through.
    """

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        began = False

        async def watched(message: Message) -> None:
            nonlocal began
            began = True
            await send(message)

        try:
            await self._app(scope, receive, watched)
        except Exception:
            if scope["type"] != "http" or began:
                raise
            _log.exception("%s %s failed", scope["method"], scope["path"])
            problem = InternalError("The request could not be carried out. The log says why.")
            await respond(problem)(scope, receive, send)
