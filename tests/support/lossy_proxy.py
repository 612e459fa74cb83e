"""A TCP connection as a bad network makes it: late, stalled, cut."""

from __future__ import annotations

import asyncio
import contextlib
import threading
from collections.abc import Iterator
from contextlib import contextmanager

CHUNK = 16_384
BACKLOG = 10_000
"""Pieces that may be on their way: a network with far too large buffers."""


class LossyProxy:
    """Stands between a browser and a server; what it does can change at any moment.

    Bytes keep their order and none gets lost, as TCP promises: loss shows itself as delay, as a
    stall, or as a connection that ends.

    Args:
        port: Of the server, on this machine.

    Attributes:
        delay_s: How long each piece is on its way, in either direction.
        url: Where a browser finds the server behind it.
    """

    def __init__(self, port: int) -> None:
        self.delay_s = 0.0
        self.url = ""
        self._port = port
        self._loop = asyncio.new_event_loop()
        self._flowing = asyncio.Event()
        self._flowing.set()
        self._writers: set[asyncio.StreamWriter] = set()
        self._tasks: set[asyncio.Task[None]] = set()

    def stall(self) -> None:
        """Hold everything back until `flow`."""
        self._loop.call_soon_threadsafe(self._flowing.clear)

    def flow(self) -> None:
        """Let go of what was held back."""
        self._loop.call_soon_threadsafe(self._flowing.set)

    def cut(self) -> None:
        """End all connections; new ones may be made."""

        def close() -> None:
            for writer in self._writers:
                writer.transport.abort()

        self._loop.call_soon_threadsafe(close)

    async def _connected(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        try:
            there = await asyncio.open_connection("127.0.0.1", self._port)
        except OSError:
            writer.transport.abort()
            return
        for source, target in ((reader, there[1]), (there[0], writer)):
            task = self._loop.create_task(self._carry(source, target))
            self._tasks.add(task)
            task.add_done_callback(self._tasks.discard)

    async def _carry(self, source: asyncio.StreamReader, target: asyncio.StreamWriter) -> None:
        """Read at once, write later: what is on its way waits here and not at the server."""
        line: asyncio.Queue[tuple[float, bytes]] = asyncio.Queue(BACKLOG)
        self._writers.add(target)
        reading = self._loop.create_task(self._read(source, line))
        try:
            while True:
                sent_s, piece = await line.get()
                await asyncio.sleep(sent_s + self.delay_s - self._loop.time())
                await self._flowing.wait()
                if not piece:
                    break
                target.write(piece)
                await target.drain()
        except ConnectionError:
            pass  # one side has gone: so does the other
        finally:
            reading.cancel()
            self._writers.discard(target)
            target.close()

    async def _read(
        self, source: asyncio.StreamReader, line: asyncio.Queue[tuple[float, bytes]]
    ) -> None:
        piece = b"."
        while piece:
            try:
                piece = await source.read(CHUNK)
            except ConnectionError:
                piece = b""
            await line.put((self._loop.time(), piece))

    async def _serve(self, started: threading.Event, ended: asyncio.Event) -> None:
        server = await asyncio.start_server(self._connected, "127.0.0.1", 0)
        self.url = f"http://127.0.0.1:{server.sockets[0].getsockname()[1]}"
        started.set()
        await ended.wait()
        server.close()
        for task in list(self._tasks):
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        for writer in list(self._writers):
            writer.transport.abort()

    @contextmanager
    def running(self) -> Iterator[LossyProxy]:
        """Carries in a thread of its own until the block ends."""
        started, ended = threading.Event(), asyncio.Event()
        thread = threading.Thread(
            target=self._loop.run_until_complete, args=(self._serve(started, ended),)
        )
        thread.start()
        try:
            assert started.wait(10), "the proxy did not start"
            yield self
        finally:
            self._loop.call_soon_threadsafe(ended.set)
            thread.join()
            with contextlib.suppress(RuntimeError):
                self._loop.close()
