"""The newest events, for those who follow them and for those who come back."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import AsyncGenerator, Callable, Sequence
from dataclasses import dataclass

from uuid6 import uuid7

from server.control.listeners import Listeners
from server.schema.events import Event

KEPT = 1000


@dataclass(frozen=True, slots=True)
class Told:
    """An event as it is told everywhere.

    Attributes:
        event: What happened.
        json: The same, in the one spelling that is signed and streamed.
    """

    event: Event
    json: str


class EventLog:
    """Keeps the last events in memory.

    Args:
        kept: So many.
    """

    def __init__(self, kept: int = KEPT) -> None:
        self._told: deque[Told] = deque(maxlen=kept)
        self._listeners: list[Callable[[Told], None]] = []
        self._news = Listeners()
        self._followers: set[asyncio.Event] = set()
        self._news.add(self._wake)

    @staticmethod
    def new_id() -> str:
        """An id that sorts after all before it."""
        return str(uuid7())

    def listen(self, listener: Callable[[Told], None]) -> None:
        """Call ``listener`` with every event from now on. It must not fail or block."""
        self._listeners.append(listener)

    def tell(self, event: Event) -> None:
        """Something has happened."""
        told = Told(event, event.model_dump_json())
        self._told.append(told)
        for listener in self._listeners:
            listener(told)
        self._news.tell()

    @property
    def known(self) -> Sequence[Told]:
        """All that are kept, oldest first."""
        return list(self._told)

    def since(self, event_id: str) -> Sequence[Told] | None:
        """What came after an event; None when that event is not known any more."""
        known = list(self._told)
        for index, told in enumerate(known):
            if told.event.id == event_id:
                return known[index + 1 :]
        return None

    async def follow(self, after: str | None = None) -> AsyncGenerator[Told | None]:
        """Events as they happen, without an end.

        Args:
            after: Begin after this event; None begins now.

        Yields:
            Events; None in place of those that are not known any more, because ``after`` is too
            old or the follower too slow.
        """
        news = asyncio.Event()
        self._followers.add(news)
        try:
            last = after if after is not None else self._newest_id()
            while True:
                missed = list(self._told) if last is None else self.since(last)
                if missed is None:
                    yield None
                    last = self._newest_id()
                    continue
                for told in missed:
                    last = told.event.id
                    yield told
                await news.wait()
                news.clear()
        finally:
            self._followers.discard(news)

    def _newest_id(self) -> str | None:
        return self._told[-1].event.id if self._told else None

    def _wake(self) -> None:
        for news in self._followers:
            news.set()
