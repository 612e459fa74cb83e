"""The newest pictures of the board, for whoever watches while they are collected."""

from __future__ import annotations

import asyncio

from server.calibration.routines.errors import NoRoutineError
from server.schema.board import BoardLook

KEPT = 4
"""Pictures kept for those who have just read that there is one."""


class BoardFeed:
    """What the camera routine sees; empty while there is none."""

    def __init__(self) -> None:
        self._sequence = 0
        self._newest: BoardLook | None = None
        self._pictures: dict[int, bytes] = {}
        self._open = False
        self._news = asyncio.Condition()

    @property
    def next_sequence(self) -> int:
        """Number of the next picture."""
        return self._sequence + 1

    def open(self) -> None:
        """A routine is about to look."""
        self._open = True

    async def show(self, look: BoardLook, jpeg: bytes) -> None:
        """There is a new picture."""
        self._sequence, self._newest = look.sequence, look
        self._pictures[look.sequence] = jpeg
        self._pictures.pop(look.sequence - KEPT, None)
        async with self._news:
            self._news.notify_all()

    async def close(self) -> None:
        """It looks no more; whoever waits is told so."""
        self._open = False
        self._newest = None
        self._pictures.clear()
        async with self._news:
            self._news.notify_all()

    async def other_than(self, sequence: int) -> BoardLook:
        """The newest look unless it has this number; then the next one.

        Raises:
            NoRoutineError: nobody looks for a board.
        """
        while self._open:
            if self._newest is not None and self._newest.sequence != sequence:
                return self._newest
            async with self._news:
                await self._news.wait()
        raise NoRoutineError("No camera is being calibrated.")

    def picture(self, sequence: int) -> bytes | None:
        """The JPEG of a number; None if it was forgotten or never was."""
        return self._pictures.get(sequence)
