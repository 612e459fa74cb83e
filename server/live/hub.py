"""Pushes live sections to any number of watchers, newest value only.

A section is serialised once for all watchers. A watcher that falls behind finds only the newest
value of each section when it asks again: there is no queue that could grow.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable, Mapping
from dataclasses import dataclass

from pydantic import BaseModel

from server.schema.live import PROTOCOL_VERSION

STALE_AFTER_S = 1.0
TOLD_AT_ONCE = 5
"""Watchers that are sent to in one turn of the event loop."""

Build = Callable[[], BaseModel | None]


@dataclass(slots=True)
class _Section:
    version: int
    json: bytes


class LiveHub:
    """Knows the newest value of every section.

    Args:
        period_s: Shortest time between two pushes of changes that are not urgent, in event loop
            time.
    """

    def __init__(self, period_s: float) -> None:
        self._period_s = period_s
        self._builders: dict[str, Build] = {}
        self._sections: dict[str, _Section] = {}
        self._dirty: set[str] = set()
        self._watchers: set[asyncio.Event] = set()
        self._timer: asyncio.TimerHandle | None = None
        self._last_push_s = 0.0

    def add(self, section: str, build: Build) -> None:
        """Add a section; ``build`` makes its value when it is needed."""
        self._builders[section] = build
        self._sections[section] = _Section(0, b"null")
        self._dirty.add(section)

    @property
    def watchers(self) -> int:
        """How many are watching."""
        return len(self._watchers)

    def changed(self, section: str, *, urgent: bool = False) -> None:
        """A section's value may have changed; urgent changes are pushed at once."""
        self._dirty.add(section)
        if not self._watchers:
            return
        loop = asyncio.get_running_loop()
        if urgent:
            self._cancel_timer()
            self._push()
        elif self._timer is None:
            due_s = max(loop.time(), self._last_push_s + self._period_s)
            self._timer = loop.call_at(due_s, self._push)

    async def watch(self) -> AsyncIterator[bytes]:
        """Messages for one watcher: a snapshot first, then deltas, as JSON."""
        news = asyncio.Event()
        try:
            # What is found to have changed here is news for those who watch already.
            self._update_all()
            self._watchers.add(news)
            seen = self._versions()
            sequence = 1
            yield self._snapshot(sequence)
            while True:
                await news.wait()
                news.clear()
                changes = {
                    name: section.json
                    for name, section in self._sections.items()
                    if section.version > seen[name]
                }
                seen = self._versions()
                if changes:
                    sequence += 1
                    yield _delta(sequence, changes)
        finally:
            self._watchers.discard(news)
            if not self._watchers:
                self._cancel_timer()

    def _push(self) -> None:
        self._timer = None
        self._last_push_s = asyncio.get_running_loop().time()
        self._update_all()

    def _update_all(self) -> None:
        if self._refresh():
            _tell(list(self._watchers))

    def _refresh(self) -> bool:
        """Bring dirty sections up to date; True when one has really changed."""
        changed = False
        for name in self._dirty:
            value = self._builders[name]()
            json = b"null" if value is None else value.model_dump_json().encode()
            section = self._sections[name]
            if json != section.json:
                section.json = json
                section.version += 1
                changed = True
        self._dirty.clear()
        return changed

    def _versions(self) -> dict[str, int]:
        return {name: section.version for name, section in self._sections.items()}

    def _snapshot(self, sequence: int) -> bytes:
        live = _object({name: section.json for name, section in self._sections.items()})
        head = b'{"type":"snapshot","version":%d,"sequence":%d,"stale_after_s":%.1f' % (
            PROTOCOL_VERSION,
            sequence,
            STALE_AFTER_S,
        )
        return b'%s,"sent_s":%.3f,"live":%s}' % (head, _now_s(), live)

    def _cancel_timer(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None


def _tell(watchers: list[asyncio.Event]) -> None:
    """Wake them a few at a time: between two groups the loop looks at its timers again.

    Sending to fifty at once keeps the loop for several milliseconds, and the robot waits.
    """
    for news in watchers[:TOLD_AT_ONCE]:
        news.set()
    if rest := watchers[TOLD_AT_ONCE:]:
        asyncio.get_running_loop().call_soon(_tell, rest)


def _delta(sequence: int, changes: Mapping[str, bytes]) -> bytes:
    head = b'{"type":"delta","sequence":%d,"sent_s":%.3f' % (sequence, _now_s())
    return b'%s,"changes":%s}' % (head, _object(changes))


def _now_s() -> float:
    return asyncio.get_running_loop().time()


def _object(members: Mapping[str, bytes]) -> bytes:
    return b"{" + b",".join(b'"%s":%s' % (k.encode(), v) for k, v in members.items()) + b"}"
