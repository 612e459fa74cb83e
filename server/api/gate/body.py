"""Takes a request's body in, as long as it is short and comes soon."""

from __future__ import annotations

import asyncio

from starlette.datastructures import Headers
from starlette.types import Message, Receive

from server.api.errors import BodyTooLargeError, BodyTooSlowError

MAX_BYTES = 64 * 1024
PATIENCE_S = 10.0
EMPTY = b""


async def read_body(headers: Headers, receive: Receive, limit: int, patience_s: float) -> bytes:
    """The whole body.

    Args:
        headers: Of the request.
        receive: Where the body comes from.
        limit: Longest body [bytes].
        patience_s: Within which it must be here [s of the event loop].

    Raises:
        BodyTooLargeError: it is longer, or says so.
        BodyTooSlowError: it did not arrive in time.
    """
    declared = headers.get("content-length")
    if declared is not None and declared.isdigit() and int(declared) > limit:
        raise BodyTooLargeError(f"The limit is {limit} bytes.", limit_bytes=limit)
    if declared in (None, "0") and "transfer-encoding" not in headers:
        return EMPTY
    parts, length = [], 0
    try:
        async with asyncio.timeout(patience_s):
            while True:
                message = await receive()
                if message["type"] != "http.request":
                    return EMPTY  # the client has gone
                parts.append(message.get("body", EMPTY))
                length += len(parts[-1])
                if length > limit:
                    raise BodyTooLargeError(f"The limit is {limit} bytes.", limit_bytes=limit)
                if not message.get("more_body", False):
                    return EMPTY.join(parts)
    except TimeoutError as error:
        raise BodyTooSlowError("The body did not arrive in time.") from error


def replayed(body: bytes, receive: Receive) -> Receive:
    """Hands a body that was read to the application, then whatever else comes."""
    given = False

    async def again() -> Message:
        nonlocal given
        if given:
            return await receive()
        given = True
        return {"type": "http.request", "body": body, "more_body": False}

    return again
