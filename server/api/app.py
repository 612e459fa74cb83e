"""The web application: routes, errors, pages and the twin around the running services."""

from __future__ import annotations

import contextlib
from collections.abc import AsyncIterator, Callable
from contextlib import AbstractAsyncContextManager
from pathlib import Path

from fastapi import Depends, FastAPI, WebSocket

from server.access.operations import twin_messages
from server.api import root_certificate
from server.api.commanding import commanding
from server.api.contract import describe
from server.api.gate import Gate, SecurityHeaders, caller_of
from server.api.pages import pages_router
from server.api.problems import ANY_PROBLEM, install_handlers
from server.api.routes import (
    access,
    board,
    calibrations,
    camera,
    charge_point,
    config,
    console,
    control,
    diagnostics,
    events,
    guidance,
    health,
    inspection,
    jobs,
    live,
    outlook,
    people,
    push,
    recordings,
    robot,
    simulation,
    station,
    target,
    vehicles,
    webhooks,
)
from server.api.twin import twin_router
from server.services import Services
from server.version import VERSION
from twin.scene import TwinHost

PREFIX = "/api/v1"
STATIC = Path(__file__).parent.parent / "static"

StartServices = Callable[[], AbstractAsyncContextManager[Services]]


def create_app(start: StartServices, twin: TwinHost | None = None) -> FastAPI:
    """Make the application. Nothing is touched before its lifespan begins.

    Args:
        start: Starts the services, and stops them when the application ends.
        twin: The 3D picture to serve at /twin/, if any.
    """

    @contextlib.asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        async with start() as services:
            app.state.services = services
            yield

    app = FastAPI(
        title="PlugPilot",
        version=VERSION,
        summary="A robot that plugs an electric car in by itself",
        lifespan=lifespan,
        openapi_url=f"{PREFIX}/openapi.json",
        docs_url=None,
        redoc_url=None,
    )
    for module in (
        health,
        robot,
        control,
        target,
        console,
        jobs,
        outlook,
        recordings,
        vehicles,
        station,
        camera,
        inspection,
        guidance,
        simulation,
        charge_point,
        events,
        webhooks,
        push,
        board,
        calibrations,
        config,
        diagnostics,
        live,
        access,
        people,
    ):
        app.include_router(
            module.router,
            prefix=PREFIX,
            responses=ANY_PROBLEM,
            dependencies=[Depends(commanding)],
        )
    if twin is not None:
        app.include_router(twin_router(twin, allowed_client_messages=_twin_messages))
    app.include_router(root_certificate.router)
    app.include_router(pages_router(STATIC))
    app.add_middleware(Gate)
    install_handlers(app)
    app.add_middleware(SecurityHeaders)
    describe(app)
    return app


def _twin_messages(socket: WebSocket) -> frozenset[str]:
    return twin_messages(caller_of(socket).rights)
