"""Carries frames between a browser and the 3D library's loopback WebSocket.

The library itself knows no accounts, no origins and no limits; all of that is here.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
import socket
from collections.abc import AsyncIterator, Callable
from importlib.metadata import version
from urllib.parse import urlsplit

import msgspec
from fastapi import WebSocket, WebSocketDisconnect
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed
from websockets.typing import Subprotocol

from server.api.twin.frames import WORTHWHILE_BYTES, repacked

logger = logging.getLogger(__name__)

AllowedClientMessages = Callable[[WebSocket], frozenset[str]]
"""Which types of messages a connected browser may send, decided once for each connection."""

SUBPROTOCOL = Subprotocol(f"viser-v{version('viser')}")
MAX_CLIENT_MESSAGE_BYTES = 4096
SEND_TIMEOUT_S = 30.0
"""In the loop's time, which a fast simulation makes shorter: long enough for a bad minute of
Wi-Fi there too."""

_LOOPBACK = "127.0.0.1"
_BUFFER_BYTES = 32 * 1024
_CLOSE_TIMEOUT_S = 1.0
_FORBIDDEN, _POLICY, _RESTARTING = 4403, 1008, 1012


def viewer_messages(_: WebSocket) -> frozenset[str]:
    """What somebody may send who only looks: where the browser's own camera is."""
    return frozenset({"ViewerCameraMessage"})


class _Head(msgspec.Struct):
    """The one field of a client message that decides whether it may pass."""

    type: str


_Vector = tuple[float, float, float]


class _ViewerCamera(msgspec.Struct, forbid_unknown_fields=True):
    """As the library expects it; its own handler fails at anything else."""

    type: str
    wxyz: tuple[float, float, float, float]
    position: _Vector
    fov: float
    near: float
    far: float
    image_height: float
    image_width: float
    look_at: _Vector
    up_direction: _Vector


_SHAPES: dict[str, type[msgspec.Struct]] = {"ViewerCameraMessage": _ViewerCamera}


def message_type(raw: bytes) -> str | None:
    """Type of a client message, None if it is not one or has not what its type must have."""
    try:
        kind = msgspec.msgpack.decode(raw, type=_Head).type
        msgspec.msgpack.decode(raw, type=_SHAPES.get(kind, _Head))
    except (msgspec.DecodeError, UnicodeDecodeError):
        return None
    return kind


def is_own_page(ws: WebSocket) -> bool:
    """Whether the browser says that a page of this very server opened the connection."""
    origin = urlsplit(ws.headers.get("origin", "")).netloc
    return bool(origin) and origin == ws.headers.get("host")


@contextlib.asynccontextmanager
async def _upstream(port: int) -> AsyncIterator[ClientConnection]:
    """A connection to the 3D library that queues as little as possible.

    Small buffers from end to end give a slow phone newer poses, not old ones later.
    """
    sock = socket.socket()
    try:
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, _BUFFER_BYTES)
        sock.setblocking(False)
        await asyncio.get_running_loop().sock_connect(sock, (_LOOPBACK, port))
        connection = await connect(
            f"ws://{_LOOPBACK}:{port}",
            sock=sock,
            subprotocols=[SUBPROTOCOL],
            compression=None,
            max_size=None,
            max_queue=1,
            ping_interval=None,
            close_timeout=_CLOSE_TIMEOUT_S,
            proxy=None,
        )
    except BaseException:
        sock.close()
        raise
    try:
        yield connection
    finally:
        await connection.close()


async def _to_browser(upstream: ClientConnection, ws: WebSocket) -> None:
    async for frame in upstream:
        if isinstance(frame, bytes):
            if len(frame) >= WORTHWHILE_BYTES:
                frame = await asyncio.to_thread(repacked, frame)  # noqa: PLW2901 - the same frame
            # A frozen tab or a lost phone takes nothing for a while; it reconnects when it can.
            async with asyncio.timeout(SEND_TIMEOUT_S):
                await ws.send_bytes(frame)


async def _to_upstream(ws: WebSocket, upstream: ClientConnection, allowed: frozenset[str]) -> None:
    while True:
        received = await ws.receive()
        if received["type"] == "websocket.disconnect":
            return
        raw = received.get("bytes")
        kind = message_type(raw) if raw and len(raw) <= MAX_CLIENT_MESSAGE_BYTES else None
        if raw is None or kind is None:
            await ws.close(_POLICY, "not a message of the 3D client")
            return
        if kind in allowed:
            await upstream.send(raw)


async def _carry(ws: WebSocket, upstream: ClientConnection, allowed: frozenset[str]) -> None:
    """Carries frames both ways until either side ends; leaves no task behind."""
    tasks = [
        asyncio.create_task(_to_browser(upstream, ws), name="twin to browser"),
        asyncio.create_task(_to_upstream(ws, upstream, allowed), name="twin from browser"),
    ]
    try:
        await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
    finally:
        for task in tasks:
            task.cancel()
        ends = await asyncio.gather(*tasks, return_exceptions=True)
    for end in ends:
        if isinstance(end, Exception) and not isinstance(
            end, WebSocketDisconnect | ConnectionClosed | TimeoutError | RuntimeError
        ):
            raise end


async def bridge(ws: WebSocket, port: int | None, allowed: AllowedClientMessages) -> None:
    """Serves one browser from its handshake to its end.

    Args:
        ws: Connection that was not accepted yet. One that did not come from a page of this
            server, or speaks another version of the client's protocol, is refused with 403.
        port: Loopback port of the 3D library, None while it is not ready: refused too, and the
            page tries again.
        allowed: Decides what the browser may send. Other types are dropped silently, because
            the stock client sends some that nobody needs; what is no message ends the
            connection.
    """
    if not is_own_page(ws) or SUBPROTOCOL not in ws.scope["subprotocols"] or port is None:
        await ws.close(_FORBIDDEN)
        return
    try:
        async with _upstream(port) as upstream:
            await ws.accept(subprotocol=SUBPROTOCOL)
            await _carry(ws, upstream, allowed(ws))
    except OSError as error:
        logger.warning("The 3D picture cannot be reached: %s", error)
    with contextlib.suppress(RuntimeError, WebSocketDisconnect):  # closed already by either side
        await ws.close(_RESTARTING)
