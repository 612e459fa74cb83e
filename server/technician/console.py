"""Keeps the newest messages between host and board while somebody looks, and no others."""

from __future__ import annotations

import asyncio
import contextlib
from collections import deque
from itertools import islice

from drivers.robot import RobotDriver
from drivers.robot.traffic import Passage, TellsTraffic, Traffic
from server.schema.console import ProtocolFrame, ProtocolFrames
from server.timing import Calendar

KEPT = 4000
MOST_WORDS = 400


class ProtocolConsole:
    """Listens to the link from the first question on, until nobody has asked for a while.

    Args:
        robot: The motion board.
        calendar: Dates.
        wait_s: Event loop time that a question waits for news.
        patience_s: Event loop time without a question after which nobody listens.
    """

    def __init__(
        self, robot: RobotDriver, calendar: Calendar, *, wait_s: float, patience_s: float
    ) -> None:
        self._traffic: Traffic | None = robot.traffic if isinstance(robot, TellsTraffic) else None
        self._calendar = calendar
        self._wait_s = wait_s
        self._patience_s = patience_s
        self._frames: deque[ProtocolFrame] = deque(maxlen=KEPT)
        self._newest = 0
        self._news = asyncio.Event()
        self._rest: asyncio.TimerHandle | None = None

    @property
    def listening(self) -> bool:
        """Whether messages are put into words and kept."""
        return self._rest is not None

    async def after(self, number: int, limit: int) -> ProtocolFrames:
        """Messages with a higher number, the oldest of them first; waits a little for some.

        Args:
            number: Of the last one that is known; one from before a restart counts as none.
            limit: At most so many; of more the newest.
        """
        self._listen()
        if number >= self._newest and self._traffic is not None:
            self._news.clear()
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(self._wait_s):
                    await self._news.wait()
        known = number if number <= self._newest else 0
        fresh = min(self._newest - known, len(self._frames), limit)
        frames = list(islice(self._frames, len(self._frames) - fresh, None))
        lost = self._newest - known - fresh if known else 0
        return ProtocolFrames(
            frames=frames,
            newest=self._newest,
            lost=lost,
            available=self._traffic is not None,
        )

    def close(self) -> None:
        """Listen no more and forget everything."""
        if self._rest is not None:
            self._rest.cancel()
            self._end()

    def _listen(self) -> None:
        if self._traffic is None:
            return
        if self._rest is None:
            self._traffic.listen(self._take)
        else:
            self._rest.cancel()
        loop = asyncio.get_running_loop()
        self._rest = loop.call_later(self._patience_s, self._end)

    def _end(self) -> None:
        self._rest = None
        self._frames.clear()
        self._newest = 0
        if self._traffic is not None:
            self._traffic.forget(self._take)

    def _take(self, passage: Passage) -> None:
        self._newest += 1
        self._frames.append(
            ProtocolFrame(
                number=self._newest,
                at=self._calendar.at(passage.at_s),
                direction="to_board" if passage.to_board else "from_board",
                kind=passage.kind,
                words=passage.words[:MOST_WORDS],
                size_bytes=passage.size_bytes,
                error=passage.error,
            )
        )
        self._news.set()
