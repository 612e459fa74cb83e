"""The protocol console: what goes over the link to the motion board."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from server.schema.base import Timestamp, Wire


class ProtocolFrame(Wire):
    """One message between host and board."""

    number: int = Field(ge=1, description="Grows by one for each, for as long as somebody looks")
    at: Timestamp
    direction: Literal["to_board", "from_board"]
    kind: str = Field(examples=["Telemetry"])
    words: str = Field(description="Its contents")
    size_bytes: int | None = Field(description="On the wire; null where there is none")
    error: bool = Field(description="It tells of something that went wrong")


class ProtocolFrames(Wire):
    """What has passed since the last look, oldest first."""

    frames: list[ProtocolFrame]
    newest: int = Field(ge=0, description="To be sent as ``after`` next time")
    lost: int = Field(ge=0, description="Frames that were forgotten before they could be read")
    available: bool = Field(description="False with a driver that cannot tell")
