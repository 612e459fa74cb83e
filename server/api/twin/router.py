"""Routes of the 3D picture: GET /twin/ and its WebSocket."""

from __future__ import annotations

import asyncio
import contextlib
import functools
from collections.abc import AsyncIterator

from fastapi import APIRouter, FastAPI, Request, Response, WebSocket
from fastapi.responses import HTMLResponse, RedirectResponse

from drivers.camera import CameraError
from server.api.dependencies import ServicesDep
from server.api.errors import CameraFailedError
from server.api.twin.bridge import AllowedClientMessages, bridge, viewer_messages
from server.api.twin.camera_picture import small_picture
from server.api.twin.client import CLIENT_PATH
from server.api.twin.page import TwinPage, build_page
from twin.scene import TwinHost

_READY_WITHIN_S = 5.0
_LOOK_AGAIN_S = 0.05
_RETRY_AFTER_S = 2

_NOT_READY = """<!doctype html><html lang="en"><meta charset="utf-8"><title>Digital twin</title>
<body style="margin:0;display:grid;place-items:center;height:100vh;background:#16181c;
color:#c8ccd2;font:16px system-ui"><p>The 3D picture is not ready yet.</p></body></html>"""


def twin_router(
    host: TwinHost, *, allowed_client_messages: AllowedClientMessages = viewer_messages
) -> APIRouter:
    """Routes for one picture.

    Args:
        host: The picture; started and stopped by the caller.
        allowed_client_messages: What a connected browser may send, by who it belongs to.
    """
    page: asyncio.Task[TwinPage] | None = None

    async def built_page() -> TwinPage:
        """Packing takes a second or more: done once, in a thread."""
        nonlocal page
        if page is None or (page.done() and page.exception() is not None):
            page = asyncio.create_task(asyncio.to_thread(_page_of_this_process))
        return await asyncio.shield(page)

    @contextlib.asynccontextmanager
    async def lifespan(_: FastAPI) -> AsyncIterator[None]:
        """The first viewer should not wait for the packing, and the start of the server not."""
        early = asyncio.create_task(built_page(), name="pack the 3D client")
        try:
            yield
        finally:
            await asyncio.gather(early, return_exceptions=True)  # told to whoever asks for it

    router = APIRouter(tags=["twin"], include_in_schema=False, lifespan=lifespan)

    @router.get("/twin")
    async def without_slash(request: Request) -> RedirectResponse:
        query = f"?{request.url.query}" if request.url.query else ""
        return RedirectResponse(f"/twin/{query}", status_code=308)

    @router.get("/twin/")
    async def page_of_twin(request: Request) -> Response:
        # A recording plays back without the live picture.
        if "playbackPath" not in request.query_params and not await _is_ready(host):
            return HTMLResponse(
                _NOT_READY,
                status_code=503,
                headers={"Retry-After": str(_RETRY_AFTER_S), "Refresh": str(_RETRY_AFTER_S)},
            )
        return _respond(request, await built_page())

    @router.get(f"/twin/{CLIENT_PATH}")
    async def client_of_page() -> Response:
        """Packed by itself; its address changes with it, so a browser asks for it once."""
        return Response(
            (await built_page()).client,
            media_type="application/octet-stream",
            headers={"Cache-Control": "private, max-age=31536000, immutable"},
        )

    @router.get("/twin/camera.jpg")
    async def camera_picture(services: ServicesDep) -> Response:
        """What the camera sees, small: the page asks for it while somebody wants to see it."""
        try:
            picture = await small_picture(services.camera)
        except CameraError as error:
            raise CameraFailedError(str(error)) from error
        return Response(picture, media_type="image/jpeg", headers={"Cache-Control": "no-store"})

    @router.websocket("/twin")  # the client takes the slash off its page's address
    @router.websocket("/twin/")
    async def frames(ws: WebSocket) -> None:
        await bridge(ws, host.port, allowed_client_messages)

    return router


@functools.cache
def _page_of_this_process() -> TwinPage:
    return build_page()


async def _is_ready(host: TwinHost) -> bool:
    """Waits a little for a picture that is still being built."""
    loop = asyncio.get_running_loop()
    deadline = loop.time() + _READY_WITHIN_S
    # Another thread builds it and knows nothing of this loop.
    while not host.ready and loop.time() < deadline:  # noqa: ASYNC110
        await asyncio.sleep(_LOOK_AGAIN_S)
    return host.ready


def _respond(request: Request, page: TwinPage) -> Response:
    headers = {
        "ETag": page.etag,
        "Cache-Control": "private, no-cache",
        "Vary": "Accept-Encoding",
        "Content-Security-Policy": page.content_security_policy,
        "X-Content-Type-Options": "nosniff",
        "Referrer-Policy": "same-origin",
    }
    if request.headers.get("if-none-match") == page.etag:
        return Response(status_code=304, headers=headers)
    if "gzip" in request.headers.get("accept-encoding", ""):
        return Response(
            page.gzipped, media_type="text/html", headers=headers | {"Content-Encoding": "gzip"}
        )
    return Response(page.html, media_type="text/html", headers=headers)
