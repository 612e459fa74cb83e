"""A real web server with the picture's routes, in the test's own event loop."""

from __future__ import annotations

import asyncio
import contextlib
import math
import socket
from collections.abc import AsyncIterator, Callable
from contextlib import AbstractAsyncContextManager

import pytest
import uvicorn
from fastapi import FastAPI, Response

from server.api.twin import AllowedClientMessages, twin_router, viewer_messages
from tests.support.browser import chromium
from tests.support.eventually import eventually
from twin.camera_mount import CameraMount
from twin.geometry import RobotGeometry
from twin.scene import TwinHost

__all__ = ["chromium"]

Serve = Callable[..., AbstractAsyncContextManager[str]]

AROUND = """<!doctype html><title>around</title><body style="margin:0">
<iframe src="/twin/?fixedDpr=0.25" style="border:0;width:160px;height:120px"></iframe>
<script>window.said = []; addEventListener("message", e => said.push(e.data.twin))</script>"""


@contextlib.asynccontextmanager
async def _serve(
    host: TwinHost, allowed: AllowedClientMessages = viewer_messages
) -> AsyncIterator[str]:
    app = FastAPI()
    app.include_router(twin_router(host, allowed_client_messages=allowed))

    @app.get("/around")
    def around() -> Response:
        return Response(AROUND, media_type="text/html")

    listener = socket.socket()
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 32 * 1024)
    listener.bind(("127.0.0.1", 0))
    config = uvicorn.Config(
        app,
        log_config=None,
        ws="websockets-sansio",
        ws_per_message_deflate=False,
        timeout_graceful_shutdown=5,
    )
    server = uvicorn.Server(config)
    running = asyncio.create_task(server.serve(sockets=[listener]))
    try:
        await eventually(lambda: server.started)
        yield f"127.0.0.1:{listener.getsockname()[1]}"
    finally:
        server.should_exit = True
        await asyncio.wait_for(running, 60)
        listener.close()


def pytest_configure(config: pytest.Config) -> None:
    """Name the mark of tests that need Chromium."""
    config.addinivalue_line("markers", "browser: opens pages in Chromium")


@pytest.fixture
def serve() -> Serve:
    """Serves a host's routes: ``async with serve(host) as "127.0.0.1:port"``."""
    return _serve


@pytest.fixture
async def host() -> AsyncIterator[TwinHost]:
    """A real picture that is ready."""
    host = TwinHost(RobotGeometry(), CameraMount(), math.radians(62.2), 4 / 3)
    host.start()
    assert await asyncio.to_thread(host.wait_ready, 20)
    yield host
    await asyncio.to_thread(host.stop)
