"""One recording under way: a bounded queue, and the task that empties it into a file."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime

from server.config.recordings import MEGABYTE
from server.recordings.file import RecordingFile
from server.recordings.topics import END, EndRecord, Record, Topic

_log = logging.getLogger(__name__)

WAITING = 1000
"""Messages that may wait for the disk: ten seconds of a moving robot."""

WRITE_PERIOD_S = 0.25
FLUSH_PERIOD_S = 1.0
"""What a power cut may take away."""

Make = Callable[[], Record | None]
"""Makes a message, in the worker thread; None when there is nothing to say."""


@dataclass(frozen=True, slots=True)
class _Waiting:
    topic: Topic
    log_time_ns: int
    make: Make


class RecordingSession:
    """The recording of one job.

    Times in the file count the robot's own seconds from the date at which the recording began,
    so that a fast simulation is not recorded as a fast robot.

    Args:
        open_file: Makes the file; blocks.
        began_at: Date of the beginning.
        began_s: The same instant in event loop time.
        largest_mb: The recording ends when its file is larger.

    Attributes:
        dropped: Messages left out because the queue was full.
        full: The recording ended before its job, because it was large enough.
    """

    def __init__(
        self,
        open_file: Callable[[], RecordingFile],
        *,
        began_at: datetime,
        began_s: float,
        largest_mb: float,
    ) -> None:
        self.dropped = 0
        self.full = False
        self._open_file = open_file
        self._origin_ns = round(began_at.timestamp() * 1e9)
        self._began_s = began_s
        self._largest_bytes = largest_mb * MEGABYTE
        self._queue: deque[_Waiting] = deque()
        self._ended = asyncio.Event()
        self._newest_s = began_s

    def stamp_ns(self, at_s: float) -> int:
        """The time in the file of an event loop time."""
        return self._origin_ns + round((at_s - self._began_s) * 1e9)

    def put(self, topic: Topic, at_s: float, make: Make) -> None:
        """Have a message written later; returns at once.

        Args:
            topic: Where it belongs.
            at_s: Event loop time of what it tells.
            make: Makes it; called in a worker thread, so everything it uses must be immutable.
        """
        if self._ended.is_set():
            return
        if len(self._queue) >= WAITING:
            self.dropped += 1
            return
        self._newest_s = max(self._newest_s, at_s)
        self._queue.append(_Waiting(topic, self.stamp_ns(at_s), make))

    def end(self) -> None:
        """Nothing more will come: write the rest and finish the file."""
        self._ended.set()

    async def write(self, left_out: Callable[[], int]) -> str | None:
        """Write until the end; returns in words why there is no recording, or None.

        Args:
            left_out: Pictures that were not kept, asked for at the end.
        """
        file: RecordingFile | None = None
        try:
            file = await asyncio.to_thread(self._open_file)
            await self._write_all(file)
            end = EndRecord(dropped=self.dropped, pictures_left_out=left_out())
            await asyncio.to_thread(self._finish, file, end)
        except OSError as error:
            await self._give_up(file)
            return f"{error.strerror or error}"
        except Exception:  # noqa: BLE001 - logged; a recording must not disturb its job
            _log.exception("the recorder failed in a way nobody thought of")
            await self._give_up(file)
            return "something went wrong; the log has the details"
        return None

    async def _write_all(self, file: RecordingFile) -> None:
        loop = asyncio.get_running_loop()
        flushed_s = loop.time()
        while True:
            await self._pause()
            last = self._ended.is_set()
            batch, self._queue = self._queue, deque()
            flush = loop.time() - flushed_s >= FLUSH_PERIOD_S
            size = await asyncio.to_thread(_write_batch, file, batch, flush=flush)
            if flush:
                flushed_s = loop.time()
            if last:
                return
            if size > self._largest_bytes:
                self.full = True
                self.end()

    async def _pause(self) -> None:
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(WRITE_PERIOD_S):
                await self._ended.wait()

    def _finish(self, file: RecordingFile, end: EndRecord) -> None:
        file.write(END, self.stamp_ns(self._newest_s), end)
        file.finish()

    async def _give_up(self, file: RecordingFile | None) -> None:
        self._ended.set()
        self._queue.clear()
        if file is not None:
            # A full disk needs the room for the journal more than for half a recording.
            await asyncio.to_thread(file.abandon)


def _write_batch(file: RecordingFile, batch: deque[_Waiting], *, flush: bool) -> int:
    for waiting in batch:
        record = waiting.make()
        if record is not None:
            file.write(waiting.topic, waiting.log_time_ns, record)
    return file.flush() if flush else 0
