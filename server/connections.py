"""Connections that send nothing, or slowly, do not keep others out.

The web server itself waits for ever for the head of a request, and each waiting connection holds a
file descriptor; when they run out nobody gets in any more, not even with a stop. Here a connection
on which no request is under way has a time limit, and the oldest of too many makes room.
"""

from __future__ import annotations

import asyncio
import binascii
import resource
from collections.abc import Iterable
from typing import Any

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

MAX_IDLE = 2000
"""Connections without a request under way, all clients together."""

HEAD_PATIENCE_S = 10.0
"""Within which the head of a request must be here."""

STALL_PATIENCE_S = 60.0
"""Within which a client must take something of its answer."""

WANTED_FILES = 8192
WEBSOCKET_KEY_BYTES = 16
HANDSHAKE_FIELDS = (b"sec-websocket-", b"connection", b"upgrade")


class _Idle:
    """The connections of one server on which no request is under way, oldest first."""

    def __init__(self, limit: int) -> None:
        self._limit = limit
        self._connections: dict[GuardedConnection, None] = {}

    def add(self, connection: GuardedConnection) -> None:
        """Count one; the oldest of too many is cut."""
        self._connections[connection] = None
        while len(self._connections) > self._limit:
            oldest = next(iter(self._connections))
            self.discard(oldest)
            oldest.cut()

    def discard(self, connection: GuardedConnection) -> None:
        """Count one no longer."""
        self._connections.pop(connection, None)

    def __len__(self) -> int:
        return len(self._connections)


class GuardedConnection(H11Protocol):
    """One connection of the web server, with limits. `guarded` makes the class to use."""

    idle: _Idle
    speed: float

    def __init__(self, *args: Any, **kwargs: Any) -> None:  # noqa: ANN401 - as uvicorn calls it
        super().__init__(*args, **kwargs)
        self._head_timer: asyncio.TimerHandle | None = None
        self._stall_timer: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Somebody has connected."""
        super().connection_made(transport)
        self._wait_for_head()

    def connection_lost(self, exc: Exception | None) -> None:
        """The connection has ended."""
        self._forget()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Some bytes have come: a request, a part of one, or nonsense."""
        super().data_received(data)
        self._look()

    def on_response_complete(self) -> None:
        """An answer is through; the next request may come over the same connection."""
        super().on_response_complete()
        if not self.transport.is_closing() and not self._is_busy():
            self.idle.add(self)

    def handle_websocket_upgrade(self, event: h11.Request) -> None:
        """The connection becomes a WebSocket, which has limits of its own."""
        if not _is_handshake(self.headers):
            self.send_400_response("No WebSocket.")  # its library would call it our error
            return
        self._forget()
        super().handle_websocket_upgrade(event)

    def send_400_response(self, msg: str) -> None:
        """What has come is not HTTP.

        An answer that is under way would fail at the state that this brings the connection into:
        it is thrown away. What was asked for happens all the same.
        """
        if self._is_busy():
            self.cycle.disconnected = True
            self.cycle.message_event.set()
        if self.conn.our_state in {h11.IDLE, h11.SEND_RESPONSE}:
            super().send_400_response(msg)
        else:
            self.cut()

    def pause_writing(self) -> None:
        """The client does not take what is sent."""
        super().pause_writing()
        if self._stall_timer is None:
            self._stall_timer = self.loop.call_later(STALL_PATIENCE_S * self.speed, self.cut)

    def resume_writing(self) -> None:
        """The client takes again."""
        super().resume_writing()
        _stop(self._stall_timer)
        self._stall_timer = None

    def cut(self) -> None:
        """End the connection now."""
        self.transport.abort()

    def _is_busy(self) -> bool:
        return self.cycle is not None and not self.cycle.response_complete

    def _look(self) -> None:
        """A request under way is the gate's; before that, and after it, time runs."""
        if self.transport.is_closing() or self.transport.get_protocol() is not self:
            return
        if self._is_busy():
            self.idle.discard(self)
            _stop(self._head_timer)
            self._head_timer = None
        else:
            self._wait_for_head()

    def _wait_for_head(self) -> None:
        self.idle.add(self)
        if self._head_timer is None:
            self._head_timer = self.loop.call_later(HEAD_PATIENCE_S * self.speed, self.cut)

    def _forget(self) -> None:
        self.idle.discard(self)
        _stop(self._head_timer)
        self._head_timer = None
        _stop(self._stall_timer)
        self._stall_timer = None


def guarded(speed: float, max_idle: int = MAX_IDLE) -> type[GuardedConnection]:
    """The class of connections for one server.

    Args:
        speed: Seconds of the event loop per second of the wall clock.
        max_idle: Connections without a request that may be open.
    """
    values = {"idle": _Idle(max_idle), "speed": speed}
    return type("Connection", (GuardedConnection,), values)


def allow_many_files() -> None:
    """Take as many file descriptors as the system gives without asking, up to a sensible number."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted = WANTED_FILES if hard == resource.RLIM_INFINITY else min(WANTED_FILES, hard)
    if soft != resource.RLIM_INFINITY and soft < wanted:
        resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))


def _is_handshake(headers: Iterable[tuple[bytes, bytes]]) -> bool:
    """Whether an upgrade can be one to a WebSocket (RFC 6455, section 4.1): ASCII, and a key."""
    fields = [(name, value) for name, value in headers if name.startswith(HANDSHAKE_FIELDS)]
    if not all(value.isascii() for _, value in fields):
        return False
    try:
        key = binascii.a2b_base64(dict(fields).get(b"sec-websocket-key", b""), strict_mode=True)
    except binascii.Error:
        return False
    return len(key) == WEBSOCKET_KEY_BYTES


def _stop(timer: asyncio.TimerHandle | None) -> None:
    if timer is not None:
        timer.cancel()
