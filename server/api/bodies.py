"""Bodies of requests are bounded in size and time.

A request without a body is never held up by this: a stop is not read, so nothing can be wrong
with it.
"""

from __future__ import annotations

import asyncio

from starlette.exceptions import HTTPException
from starlette.types import ASGIApp, Message, Receive, Scope, Send

LARGEST_BODY = 256 * 1024
LONGEST_WAIT_S = 20.0
"""For a whole body."""

TOO_LARGE, TOO_SLOW = 413, 408


class BodyMiddleware:
    """Ends the reading of a body that is too large or too slow.

    Args:
        app: What reads the bodies.
        speed: Seconds of the event loop per second of the world outside.
    """

    def __init__(self, app: ASGIApp, speed: float = 1.0) -> None:
        self._app = app
        self._wait_s = LONGEST_WAIT_S * speed

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one connection."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        body = _Body(receive, _said_length(scope), self._wait_s)
        await self._app(scope, body.receive, send)


class _Body:
    def __init__(self, receive: Receive, said: int, wait_s: float) -> None:
        self._receive = receive
        self._said = said
        self._wait_s = wait_s
        self._until_s: float | None = None
        self._size = 0
        self._complete = False

    async def receive(self) -> Message:
        if self._complete:
            return await self._receive()
        if self._said > LARGEST_BODY:
            raise HTTPException(TOO_LARGE)
        if self._until_s is None:
            self._until_s = asyncio.get_running_loop().time() + self._wait_s
        try:
            async with asyncio.timeout_at(self._until_s):
                message = await self._receive()
        except TimeoutError:
            raise HTTPException(TOO_SLOW) from None
        self._size += len(message.get("body", b""))
        self._complete = not message.get("more_body", False)
        if self._size > LARGEST_BODY:
            raise HTTPException(TOO_LARGE)
        return message


def _said_length(scope: Scope) -> int:
    for name, value in scope["headers"]:
        if name == b"content-length" and value.isdigit():
            return int(value)
    return 0
