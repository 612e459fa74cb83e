"""Versions of what can be changed, so that nobody overwrites what they have not seen."""

from __future__ import annotations

import hashlib
from typing import Annotated, Any

from fastapi import Header
from pydantic import BaseModel

from server.api.errors import PreconditionFailedError, PreconditionRequiredError

IfMatch = Annotated[
    str | None,
    Header(
        max_length=1000,
        description="The ETag of what is to be changed, as it was last read; * means whatever "
        "there is",
        examples=['"8c2f0a3be1d94f66"'],
    ),
]

ETAG_HEADER: dict[str, Any] = {
    "ETag": {
        "description": "Version of this; send it as If-Match with a change",
        "schema": {"type": "string"},
    }
}

VERSIONED: dict[int | str, dict[str, Any]] = {200: {"headers": ETAG_HEADER}}
"""What an operation documents whose answer has a version."""


def etag_of(content: BaseModel) -> str:
    """The version of a representation: another content, another tag."""
    return f'"{hashlib.sha256(content.model_dump_json().encode()).hexdigest()[:16]}"'


def require_match(if_match: str | None, known: BaseModel) -> None:
    """Make sure that whoever changes something has seen what is there.

    Raises:
        PreconditionRequiredError: there is no If-Match.
        PreconditionFailedError: it names another version.
    """
    if if_match is None:
        raise PreconditionRequiredError("The header If-Match is missing.")
    refuse_mismatch(if_match, known)


def refuse_mismatch(if_match: str | None, known: BaseModel | None) -> None:
    """The same for a request that may come without If-Match, or find nothing.

    Raises:
        PreconditionFailedError: it names another version.
    """
    if if_match is None:
        return
    tags = {tag.strip() for tag in if_match.split(",")}
    if known is None or not tags & {"*", etag_of(known)}:
        raise PreconditionFailedError(f"If-Match names {if_match[:60]}, which is not there now.")
