"""Sockets whose other side has gone, on every event loop that serves browsers."""

from __future__ import annotations

import asyncio
import errno
from typing import Any


def forgive_the_vanished(loop: asyncio.AbstractEventLoop) -> None:
    """Do not take it for an error of ours when a client vanishes while its connection is closed.

    asyncio writes a whole trace into the log then, so that a stranger could fill it.
    """

    def handle(_: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
        error = context.get("exception")
        if not (isinstance(error, OSError) and error.errno == errno.ENOTCONN):
            loop.default_exception_handler(context)

    loop.set_exception_handler(handle)
