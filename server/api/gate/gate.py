"""Lets requests through to the application, or answers in its place."""

from __future__ import annotations

import asyncio
import logging
import math
from functools import partial

from fastapi import FastAPI
from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from server.access import OPERATIONS, Access, Caller, Need
from server.access.audit import ACCESS_CHANGED, OPERATION
from server.access.errors import (
    AccessError,
    ForbiddenError,
    NotPairedError,
    TooManyAttemptsError,
    UnknownHostError,
    WrongOriginError,
)
from server.access.operations import FREQUENT, LARGE_BODIES, LIMITED, STOPS, TOLD
from server.api.errors import BodyTooLargeError, BodyTooSlowError
from server.api.gate.body import MAX_BYTES, PATIENCE_S, read_body, replayed
from server.api.gate.caller import find_caller, scheme_of
from server.api.gate.origin import is_from_elsewhere, is_own_host
from server.api.gate.routes import Operation, RouteTable
from server.api.gate.watch import UNPAIRED, Watched
from server.api.problems import respond
from server.errors import PlugPilotError
from server.services import Services

_log = logging.getLogger(__name__)

SAFE_METHODS = frozenset({"GET", "HEAD", "OPTIONS"})
LINKED = frozenset({"GET /", "GET /root.crt"})
"""What a link on anybody's page may open."""

ABOUT_ACCESS = frozenset({Need.ADMIN, Need.PERSON})

TARPIT_S = 1.0
"""How long somebody waits who tries too often: whoever floods the server slows down himself."""


class Gate:
    """Asks of each request: to whom, from where, by whom, may they, how much, how fast.

    What is behind the gate finds the caller with `caller_of`. A stop passes without limits; on the
    machine itself it needs nobody.
    """

    def __init__(self, app: ASGIApp) -> None:
        self._app = app
        self._routes: RouteTable | None = None

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one request or connection."""
        if scope["type"] not in {"http", "websocket"}:
            self._table(scope["app"])  # it takes a while: not when somebody asks, and a robot moves
            await self._app(scope, receive, send)
            return
        services: Services = scope["app"].state.services
        operation = self._table(scope["app"]).find(scope)
        headers = Headers(scope=scope)
        caller = find_caller(scope, headers, services.access)
        scope.setdefault("state", {})["caller"] = caller
        try:
            _check(services.access, operation, caller, scope, headers)
            if operation is None:
                await self._app(scope, receive, send)  # which says that there is nothing
                return
            _count(services, operation, caller)
            receive = await _with_body(services, operation, scope, receive)
            ends = Watched(receive, send, partial(_still_may, services.access, caller, operation))
            noted = _noted(services.access, operation, caller, scope, ends.send)
            await self._app(scope, ends.receive, noted)
        except (AccessError, BodyTooLargeError, BodyTooSlowError) as error:
            name = operation.name if operation is not None else scope["path"][:100]
            services.access.audit.record_burst(
                "refused",
                actor=caller.label,
                address=caller.address,
                operation=name,
                code=error.code,
            )
            if isinstance(error, TooManyAttemptsError):
                await asyncio.sleep(TARPIT_S * services.settings.clock_speed)
            await _refuse(error, scope, receive, send)

    def _table(self, app: FastAPI) -> RouteTable:
        if self._routes is None:
            self._routes = RouteTable(app.routes, OPERATIONS)
            for name in self._routes.unlisted:
                _log.error("%s stands in no table of rights, so nobody may use it", name)
        return self._routes


def _count(services: Services, operation: Operation, caller: Caller) -> None:
    """Count attempts of those who may be anybody."""
    access, speed = services.access, services.settings.clock_speed
    now_s = asyncio.get_running_loop().time()
    if operation.name in LIMITED and not access.attempts.allow(caller.address, now_s):
        wait_s = math.ceil(access.attempts.wait_s / speed)
        raise TooManyAttemptsError(f"Try again in {wait_s} s.", wait_s=wait_s)


async def _with_body(
    services: Services, operation: Operation, scope: Scope, receive: Receive
) -> Receive:
    """The request with its body read, so that what is behind the gate never waits for it."""
    if scope["type"] != "http" or operation.name in STOPS:
        return receive
    limit = LARGE_BODIES.get(operation.name, MAX_BYTES)
    patience_s = PATIENCE_S * services.settings.clock_speed
    return replayed(await read_body(Headers(scope=scope), receive, limit, patience_s), receive)


def _check(
    access: Access,
    operation: Operation | None,
    caller: Caller,
    scope: Scope,
    headers: Headers,
) -> None:
    host = headers.get("host", "")
    if not is_own_host(host, access.settings.host_names):
        raise UnknownHostError(f"{host[:100]!r} is not a name of this robot.")
    opens_page = operation is not None and operation.name in LINKED
    if is_from_elsewhere(headers, scheme_of(scope), opens_page=opens_page):
        raise WrongOriginError("The browser says that another page asks for this.")
    if operation is None or operation.need in caller.rights:
        return
    if caller.kind in {"unknown", "machine"}:
        raise NotPairedError("The robot does not know who asks.")
    raise ForbiddenError(f"{caller.name or 'This program'} may not do that.")


def _still_may(access: Access, caller: Caller, operation: Operation) -> bool:
    return operation.need in access.register.rights_now(caller)


def _noted(access: Access, operation: Operation, caller: Caller, scope: Scope, send: Send) -> Send:
    """Tells the audit trail how it went, once the answer to a change begins."""
    if scope["type"] != "http" or scope["method"] in SAFE_METHODS or operation.need is Need.ANYONE:
        return send  # what anybody may try, pairing above all, tells the trail itself

    async def noting(message: Message) -> None:
        if message["type"] == "http.response.start":
            ok = message["status"] < 400
            if ok and operation.name in TOLD:
                await send(message)
                return
            record = access.audit.record
            if operation.name in FREQUENT or not ok:
                record = access.audit.record_burst
            record(
                ACCESS_CHANGED if operation.need in ABOUT_ACCESS else OPERATION,
                actor=caller.label,
                address=caller.address,
                operation=operation.name,
                path=scope["path"][:200],
                status=message["status"],
            )
        await send(message)

    return noting


async def _refuse(error: PlugPilotError, scope: Scope, receive: Receive, send: Send) -> None:
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": UNPAIRED, "reason": ""})
        return
    headers = {"Connection": "close"} if error.status in {408, 413, 429} else {}
    if "wait_s" in error.context:
        headers["Retry-After"] = str(error.context["wait_s"])
    if error.status == NotPairedError.status:
        headers["WWW-Authenticate"] = "Bearer"
    await respond(error, headers)(scope, receive, send)
