"""The control channel of a simulator in real time: a socket."""

from __future__ import annotations

import asyncio
import json
from collections import deque
from collections.abc import Callable
from pathlib import Path
from typing import Any, Self

from tests.rig.control import ControlError
from tests.rig.truth import TrueState


class SocketChannel:
    """A Channel to a simulator that runs by itself."""

    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self._reader = reader
        self._writer = writer
        self._waiting: deque[asyncio.Future[dict[str, Any]]] = deque()
        self._listeners: list[Callable[[TrueState], None]] = []
        self._task = asyncio.create_task(self._listen(), name="rig control")

    @classmethod
    async def connect(cls, path: Path) -> Self:
        """Open the channel of a running simulator."""
        return cls(*await asyncio.open_unix_connection(path))

    async def close(self) -> None:
        """Hang up."""
        self._task.cancel()
        await asyncio.wait([self._task])
        self._writer.close()
        await self._writer.wait_closed()

    def on_sample(self, listener: Callable[[TrueState], None]) -> None:
        """Call with every sample that the simulator takes by itself."""
        self._listeners.append(listener)

    async def say(self, line: str) -> dict[str, Any]:
        """Send a command and wait for its answer.

        Raises:
            ControlError: it was refused, or the simulator has ended.
        """
        return await self._send(line)

    def say_soon(self, line: str) -> None:
        """Send a command before all later ones; nobody waits for its answer."""
        self._send(line).add_done_callback(lambda done: done.cancelled() or done.exception())

    def _send(self, line: str) -> asyncio.Future[dict[str, Any]]:
        answer: asyncio.Future[dict[str, Any]] = asyncio.get_running_loop().create_future()
        if self._task.done():
            answer.set_exception(ControlError("the simulator has ended"))
        else:
            self._waiting.append(answer)
            self._writer.write(line.encode() + b"\n")
        return answer

    async def _listen(self) -> None:
        try:
            while line := await self._reader.readline():
                self._take(json.loads(line))
        finally:
            while self._waiting:
                self._fail(self._waiting.popleft(), "the simulator has ended")

    def _take(self, message: dict[str, Any]) -> None:
        if "sample" in message:
            sample = TrueState.model_validate(message["sample"])
            for listener in self._listeners:
                listener(sample)
            return
        answer = self._waiting.popleft()
        if "error" in message:
            self._fail(answer, message["error"])
        elif not answer.done():
            answer.set_result(message)

    @staticmethod
    def _fail(answer: asyncio.Future[dict[str, Any]], words: str) -> None:
        if not answer.done():
            answer.set_exception(ControlError(words))
