"""Where the web server listens."""

from __future__ import annotations

from pydantic import Field

from server.config.section import Section


class ServerSettings(Section):
    """The address of the pages and of the API."""

    host: str = Field(
        "127.0.0.1",
        min_length=1,
        description="Address to listen on; 0.0.0.0 lets everyone in the network in",
    )
    port: int = Field(8000, ge=0, le=65_535, description="TCP port; 0 takes any free one")
