"""What runs here."""

from __future__ import annotations

from datetime import date

from pydantic import Field

from server.schema.base import Wire


class LibraryVersion(Wire):
    """One library that this software is built on."""

    name: str
    version: str


class Release(Wire):
    """What one release of this software brought."""

    version: str
    released_on: date
    changes: list[str] = Field(description="Sentences in English")


class Versions(Wire):
    """Software, firmware and the protocol between them."""

    software: str
    python: str
    system: str
    libraries: list[LibraryVersion]
    board: str | None = Field(description="Null before the board has introduced itself")
    firmware: str | None
    protocol_hash: str = Field(
        description="Of the protocol that this software speaks; a board whose firmware was built "
        "for another one is refused"
    )
    releases: list[Release] = Field(description="The newest first")
