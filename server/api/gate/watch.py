"""Ends what is under way when the caller's rights end: streams and WebSockets."""

from __future__ import annotations

from collections.abc import Callable

from starlette.types import Message, Receive, Send

UNPAIRED = 4401
"""Close code of a WebSocket whose browser is not paired any more."""


class Watched:
    """A connection that goes on only as long as it may.

    Looked at with every message, which costs a look into two tables in memory.

    Args:
        receive: The connection's.
        send: The connection's.
        allowed: Whether the caller still may.
    """

    def __init__(self, receive: Receive, send: Send, allowed: Callable[[], bool]) -> None:
        self._receive = receive
        self._send = send
        self._allowed = allowed
        self._ended = False
        self._endless = False

    async def receive(self) -> Message:
        """The next message, or the end."""
        if self._ended:
            return {"type": "websocket.disconnect", "code": UNPAIRED}
        message = await self._receive()
        if message["type"] == "websocket.receive" and not self._allowed():
            await self._close()
            return {"type": "websocket.disconnect", "code": UNPAIRED}
        return message

    async def send(self, message: Message) -> None:
        """Pass a message on, or end the connection."""
        if self._ended:
            return
        if message["type"] == "http.response.start":
            self._endless = all(name.lower() != b"content-length" for name, _ in message["headers"])
        if not self._allowed():
            if message["type"] == "websocket.send":
                await self._close()
                return
            if message["type"] == "http.response.body" and self._endless:
                self._ended = True
                await self._send({"type": "http.response.body", "body": b"", "more_body": False})
                return
        await self._send(message)

    async def _close(self) -> None:
        self._ended = True
        await self._send(
            {"type": "websocket.close", "code": UNPAIRED, "reason": "not paired any more"}
        )
