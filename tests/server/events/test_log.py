"""Following events, and coming back."""

from __future__ import annotations

import asyncio
from datetime import UTC, datetime

from server.events import EventLog
from server.schema.events import Ping, PingEvent


def tell(log: EventLog, count: int = 1) -> list[str]:
    ids = []
    for number in range(count):
        event = PingEvent(
            id=log.new_id(), timestamp=datetime.now(UTC), data=Ping(message=str(number))
        )
        log.tell(event)
        ids.append(event.id)
    return ids


async def take(log: EventLog, count: int, after: str | None = None) -> list[str | None]:
    following = log.follow(after)
    taken = []
    async with asyncio.timeout(5):
        for _ in range(count):
            told = await anext(following)
            taken.append(None if told is None else told.event.id)
    await following.aclose()
    return taken


async def test_whoever_comes_back_gets_what_was_missed() -> None:
    log = EventLog()
    ids = tell(log, 5)
    assert await take(log, 3, after=ids[1]) == ids[2:]
    assert [told.event.id for told in log.since(ids[3]) or ()] == ids[4:]
    assert list(log.since(ids[4]) or ()) == []


async def test_whoever_comes_new_gets_only_what_is_new() -> None:
    log = EventLog()
    tell(log, 3)
    waiting = asyncio.create_task(take(log, 2))
    await asyncio.sleep(0)
    await asyncio.sleep(0)
    ids = tell(log, 2)
    assert await waiting == ids


async def test_the_first_event_of_all_is_not_lost() -> None:
    log = EventLog()
    waiting = asyncio.create_task(take(log, 1))
    await asyncio.sleep(0)
    await asyncio.sleep(0)
    ids = tell(log, 1)
    assert await waiting == ids


async def test_what_is_forgotten_shows_as_a_gap() -> None:
    log = EventLog(kept=3)
    ids = tell(log, 10)
    assert log.since(ids[0]) is None
    assert await take(log, 1, after=ids[0]) == [None]
    assert await take(log, 1, after="01957a3c-7d50-7c44-8e0f-5b3c9d5a1f00") == [None]


async def test_a_follower_who_is_too_slow_is_told_so_and_goes_on() -> None:
    log = EventLog(kept=3)
    following = log.follow()
    first = asyncio.create_task(anext(following))
    await asyncio.sleep(0)
    (one,) = tell(log, 1)
    told = await first
    assert told is not None
    assert told.event.id == one
    tell(log, 10)
    assert await anext(following) is None
    (last,) = tell(log, 1)
    told = await anext(following)
    assert told is not None
    assert told.event.id == last
    await following.aclose()
