"""Routes of the 3D picture: GET /twin/ and its WebSocket."""

from __future__ import annotations

import asyncio

from fastapi import APIRouter, Request, Response, WebSocket
from fastapi.responses import HTMLResponse, RedirectResponse

from server.api.twin.bridge import AllowedClientMessages, bridge, viewer_messages
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
    router = APIRouter(tags=["twin"], include_in_schema=False)
    page: asyncio.Task[TwinPage] | None = None

    async def built_page() -> TwinPage:
        """Compressing takes a tenth of a second: done once, when first asked, in a thread."""
        nonlocal page
        if page is None or (page.done() and page.exception() is not None):
            page = asyncio.create_task(asyncio.to_thread(build_page))
        return await asyncio.shield(page)

    @router.get("/twin")
    async def without_slash(request: Request) -> RedirectResponse:
        query = f"?{request.url.query}" if request.url.query else ""
        return RedirectResponse(f"/twin/{query}", status_code=308)

    @router.get("/twin/")
    async def page_of_twin(request: Request) -> Response:
        if not await _is_ready(host):
            return HTMLResponse(
                _NOT_READY,
                status_code=503,
                headers={"Retry-After": str(_RETRY_AFTER_S), "Refresh": str(_RETRY_AFTER_S)},
            )
        return _respond(request, await built_page())

    @router.websocket("/twin")  # the client takes the slash off its page's address
    @router.websocket("/twin/")
    async def frames(ws: WebSocket) -> None:
        await bridge(ws, host.port, allowed_client_messages)

    return router


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
