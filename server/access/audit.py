"""The audit trail: who did what, from where. Only ever added to.

Each entry holds a digest over itself and the one before (a hash chain), and the database refuses
changes (server/storage/access_tables.py), so a change made behind its back can be found.

What repeats is one entry per burst: the first occurrence is written at once, and when it has been
quiet for a while one more entry says how often it came again.
"""

from __future__ import annotations

import asyncio
import hashlib
import json
import logging
from collections.abc import AsyncIterator, Callable, Iterator
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from functools import partial
from typing import Any

from sqlalchemy import select
from sqlalchemy.orm import Session

from server.storage.access_tables import AuditRow
from server.storage.database import Database
from server.storage.errors import StorageError

_log = logging.getLogger(__name__)

BURST_S = 60.0
MAX_BURSTS = 200
"""Different bursts at a time. An attacker with more addresses than that fills one entry, not the
disk: all further ones count as one burst."""

OPERATION = "operation"
"""The event of everything that people and machines do with the robot."""

ACCESS_CHANGED = "access"
"""The event of everything that somebody changes about who may do what."""

FIRST_LINK = "0" * 64
PAGE = 500
ATTEMPTS = 3


@dataclass(frozen=True, slots=True)
class AuditEntry:
    """One entry.

    Attributes:
        event: What happened, as a stable word, such as "pairing.refused".
        actor: Who did it.
        address: Where it came from.
        detail: Facts, plain JSON. Never a secret.
        times: How often it happened.
        at: When; of a burst, when it was last seen.
        sequence: Number of the entry, from 1 without gaps.
        chain: Digest over this entry and the one before.
    """

    event: str
    actor: str
    address: str
    at: datetime
    detail: dict[str, Any] = field(default_factory=dict)
    times: int = 1
    sequence: int = 0
    chain: str = ""

    def as_json(self) -> dict[str, Any]:
        """The entry as it is exported."""
        at = self.at.astimezone(UTC).isoformat(timespec="microseconds")
        return {name: getattr(self, name) for name in type(self).__slots__} | {"at": at}

    @classmethod
    def from_json(cls, content: dict[str, Any]) -> AuditEntry:
        """An exported entry read again."""
        return cls(**content | {"at": datetime.fromisoformat(content["at"])})

    def link(self, previous: str) -> str:
        """The digest that this entry has after another one's."""
        # As SQLite keeps them: dates in UTC to the microsecond.
        content = [
            self.sequence,
            self.at.astimezone(UTC).isoformat(timespec="microseconds"),
            self.event,
            self.actor,
            self.address,
            self.detail,
            self.times,
        ]
        packed = json.dumps(content, sort_keys=True, separators=(",", ":"))
        return hashlib.sha256(f"{previous}{packed}".encode()).hexdigest()


@dataclass(slots=True)
class _Burst:
    newest: AuditEntry
    repeated: int
    end: asyncio.TimerHandle


class AuditLog:
    """Writes the trail, off the event loop and without making anybody wait.

    Args:
        database: Where it is kept.
        now: The date.
        burst_s: How long it must be quiet for a burst to be over [s of the event loop].
    """

    def __init__(
        self, database: Database, now: Callable[[], datetime], burst_s: float = BURST_S
    ) -> None:
        self._database = database
        self._now = now
        self._burst_s = burst_s
        self._bursts: dict[tuple[str, str, str, str], _Burst] = {}
        self._waiting: list[AuditEntry] = []
        self._writing: asyncio.Task[None] | None = None

    def record(self, event: str, *, actor: str, address: str, **detail: Any) -> None:  # noqa: ANN401 - plain JSON
        """Add an entry."""
        self._add(AuditEntry(event, actor[:100], address[:64], self._now(), detail))

    def record_burst(self, event: str, *, actor: str, address: str, **detail: Any) -> None:  # noqa: ANN401 - plain JSON
        """Add an entry for something that may come a thousand times a second."""
        key = (event, actor, address, str(detail.get("operation", "")))
        if key not in self._bursts and len(self._bursts) >= MAX_BURSTS:
            key, actor, address, detail = (event, "", "", ""), "many", "many", {}
        entry = AuditEntry(event, actor[:100], address[:64], self._now(), detail)
        burst = self._bursts.get(key)
        if burst is None:
            self._bursts[key] = _Burst(entry, 0, self._end_later(key))
            self._add(entry)
            return
        burst.newest = entry
        burst.repeated += 1

    async def page(
        self, *, before: int | None, limit: int, security: bool = False
    ) -> list[AuditEntry]:
        """Entries, newest first.

        Args:
            before: Only those with a smaller sequence number.
            limit: At most so many.
            security: Only what concerns access, not what people do with the robot.
        """
        await self.written()

        def work(session: Session) -> list[AuditEntry]:
            query = select(AuditRow).order_by(AuditRow.sequence.desc()).limit(limit)
            if before is not None:
                query = query.where(AuditRow.sequence < before)
            if security:
                query = query.where(AuditRow.event != OPERATION)
            return [_entry(row) for row in session.scalars(query)]

        return await self._database.run(work)

    async def everything(self) -> AsyncIterator[AuditEntry]:
        """All entries, oldest first, some at a time."""
        await self.written()
        after = 0
        while chunk := await self._database.run(partial(_after, sequence=after)):
            for entry in chunk:
                yield entry
            after = chunk[-1].sequence

    async def written(self) -> None:
        """Wait until all that was recorded is on disk."""
        while self._writing is not None:
            await asyncio.shield(self._writing)

    async def close(self) -> None:
        """Write everything, open bursts too."""
        for key in list(self._bursts):
            self._end(key)
        await self.written()

    def _end_later(self, key: tuple[str, str, str, str]) -> asyncio.TimerHandle:
        return asyncio.get_running_loop().call_later(self._burst_s, self._look, key)

    def _look(self, key: tuple[str, str, str, str]) -> None:
        """Say how often it came in this while; go on counting while it comes."""
        burst = self._bursts[key]
        if burst.repeated == 0:
            del self._bursts[key]
            return
        self._add(replace(burst.newest, times=burst.repeated))
        burst.repeated = 0
        burst.end = self._end_later(key)

    def _end(self, key: tuple[str, str, str, str]) -> None:
        burst = self._bursts.pop(key)
        burst.end.cancel()
        if burst.repeated:
            self._add(replace(burst.newest, times=burst.repeated))

    def _add(self, entry: AuditEntry) -> None:
        self._waiting.append(entry)
        if self._writing is None:
            self._writing = asyncio.get_running_loop().create_task(self._write(), name="audit")

    async def _write(self) -> None:
        try:
            while self._waiting:
                entries, self._waiting = self._waiting, []
                await self._append(entries)
        finally:
            self._writing = None

    async def _append(self, entries: list[AuditEntry]) -> None:
        for attempt in range(ATTEMPTS):
            try:
                await self._database.run(partial(_append, entries=entries))
            except StorageError as error:
                # Another process, such as `plugpilot pair`, may have added an entry meanwhile.
                if attempt + 1 == ATTEMPTS:
                    # The disk is full or broken: the robot must still be stoppable by its owner.
                    _log.error("%d entries of the audit trail are lost: %s", len(entries), error)
            else:
                return


def broken_links(entries: Iterator[AuditEntry]) -> Iterator[int]:
    """Sequence numbers of entries that do not fit the one before: changed, or next to a gap."""
    previous, number = FIRST_LINK, 0
    for entry in entries:
        if entry.sequence != number + 1 or entry.link(previous) != entry.chain:
            yield entry.sequence
        previous, number = entry.chain, entry.sequence


def _append(session: Session, entries: list[AuditEntry]) -> None:
    newest = session.scalar(select(AuditRow).order_by(AuditRow.sequence.desc()).limit(1))
    number, chain = (0, FIRST_LINK) if newest is None else (newest.sequence, newest.chain)
    for each in entries:
        number += 1
        entry = replace(each, sequence=number)
        chain = entry.link(chain)
        session.add(
            AuditRow(
                sequence=number,
                at=entry.at,
                event=entry.event,
                actor=entry.actor,
                address=entry.address,
                detail=entry.detail,
                times=entry.times,
                chain=chain,
            )
        )


def _after(session: Session, sequence: int) -> list[AuditEntry]:
    query = select(AuditRow).where(AuditRow.sequence > sequence)
    return [_entry(row) for row in session.scalars(query.order_by(AuditRow.sequence).limit(PAGE))]


def _entry(row: AuditRow) -> AuditEntry:
    return AuditEntry(
        event=row.event,
        actor=row.actor,
        address=row.address,
        at=row.at,
        detail=row.detail,
        times=row.times,
        sequence=row.sequence,
        chain=row.chain,
    )
