"""Lists come in pages; a cursor says where the next one begins."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Annotated, Protocol, TypeVar
from uuid import UUID

from fastapi import Query

from server.api.errors import InvalidCursorError

T = TypeVar("T")
LARGEST_NUMBER = 2**53


class HasId(Protocol):
    """Has an id; ids sort by age."""

    @property
    def id(self) -> str:
        """A UUID of version 7."""


Entry = TypeVar("Entry", bound=HasId)

Cursor = Annotated[
    str | None,
    Query(max_length=64, description="The next_cursor of the page before; without it the first"),
]
Limit = Annotated[int, Query(ge=1, le=100, description="Entries of one page")]


def id_in(cursor: str | None) -> str | None:
    """The id in a cursor, in the one spelling that sorts among the ids.

    Raises:
        InvalidCursorError: it is none.
    """
    if cursor is None:
        return None
    try:
        return str(UUID(cursor))
    except ValueError:
        raise InvalidCursorError(f"{cursor!r} is not a cursor of this list.") from None


def number_in(cursor: str | None) -> int | None:
    """The number in a cursor.

    Raises:
        InvalidCursorError: it is none.
    """
    if cursor is None:
        return None
    if not (cursor.isascii() and cursor.isdigit() and int(cursor) <= LARGEST_NUMBER):
        raise InvalidCursorError(f"{cursor!r} is not a cursor of this list.")
    return int(cursor)


def split_page(found: Sequence[T], limit: int) -> tuple[list[T], T | None]:
    """The page, and its last entry if there are more.

    Args:
        found: One entry more than the page has, where there are more.
        limit: Entries of the page.
    """
    page = list(found[:limit])
    return page, page[-1] if len(found) > limit else None


def page_by_id(
    entries: Iterable[Entry], cursor: str | None, limit: int
) -> tuple[list[Entry], str | None]:
    """One page of entries in memory, oldest first, and the cursor of the next one.

    Raises:
        InvalidCursorError: the cursor is none.
    """
    after = id_in(cursor) or ""
    found = sorted((entry for entry in entries if entry.id > after), key=lambda entry: entry.id)
    page, last = split_page(found, limit)
    return page, last.id if last else None
