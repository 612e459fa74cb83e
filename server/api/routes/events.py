"""What happens, for scripts: as a list, and as Server-Sent Events."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator
from typing import Annotated

from fastapi import APIRouter, Header
from fastapi.responses import StreamingResponse

from server.api.dependencies import ServicesDep
from server.api.pagination import Cursor, Limit, id_in, split_page
from server.api.problems import problem_responses
from server.events.log import EventLog, Told
from server.schema.event_list import EventPage

router = APIRouter(prefix="/events", tags=["events"])

SILENCE_S = 15.0
"""After so long without an event a comment is sent, so that nobody takes the line for dead."""
RETRY_MS = 2000
_HEADERS = {"Cache-Control": "no-store", "X-Accel-Buffering": "no"}
LastEventId = Annotated[
    str | None,
    Header(max_length=64, description="Continue after this event, as browsers do by themselves"),
]


@router.get("", operation_id="listEvents", summary="List events", responses=problem_responses(400))
async def list_events(
    services: ServicesDep, cursor: Cursor = None, limit: Limit = 100
) -> EventPage:
    """The newest events, oldest first; what a restart has taken away is not in it."""
    after = id_in(cursor)
    found = services.events.known if after is None else services.events.since(after)
    page, last = split_page(services.events.known if found is None else found, limit)
    return EventPage(
        items=[told.event for told in page],
        next_cursor=last.event.id if last else None,
        complete=found is not None,
    )


@router.get(
    "/stream",
    operation_id="streamEvents",
    summary="Follow events",
    response_class=StreamingResponse,
    responses={
        200: {
            "description": "Server-Sent Events: id, event (the type) and data (the event as JSON)",
            "content": {"text/event-stream": {"schema": {"type": "string"}}},
        },
        **problem_responses(400),
    },
)
async def stream_events(
    services: ServicesDep, last_event_id: LastEventId = None
) -> StreamingResponse:
    """Events as they happen, for as long as the connection lasts.

    With Last-Event-ID also those that were missed; where they are not known any more, one event
    `gap` comes in their place: read the state again. Lines that begin with a colon mean nothing.
    """
    return StreamingResponse(
        _lines(services.events, id_in(last_event_id), SILENCE_S * services.settings.clock_speed),
        media_type="text/event-stream",
        headers=_HEADERS,
    )


async def _lines(events: EventLog, after: str | None, silence_s: float) -> AsyncIterator[str]:
    yield f"retry: {RETRY_MS}\n\n"
    following = events.follow(after)
    upcoming: asyncio.Task[Told | None] | None = None
    try:
        while True:
            upcoming = upcoming or asyncio.ensure_future(anext(following))
            done, _ = await asyncio.wait([upcoming], timeout=silence_s)
            if not done:
                yield ": nothing happens\n\n"
                continue
            told, upcoming = upcoming.result(), None
            yield _message(told)
    finally:
        if upcoming is not None:
            upcoming.cancel()
            with contextlib.suppress(asyncio.CancelledError, StopAsyncIteration):
                await upcoming
        await following.aclose()


def _message(told: Told | None) -> str:
    if told is None:
        return 'event: gap\ndata: {"type":"gap"}\n\n'
    return f"id: {told.event.id}\nevent: {told.event.type}\ndata: {told.json}\n\n"
