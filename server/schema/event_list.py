"""The newest events as a list."""

from __future__ import annotations

from pydantic import Field

from server.schema.base import Wire
from server.schema.events import Event


class EventPage(Wire):
    """Events, oldest first."""

    items: list[Event]
    next_cursor: str | None = Field(description="Pass as ?cursor= for the next page; null: end")
    complete: bool = Field(
        description="False: some that came after the cursor are not known any more"
    )
