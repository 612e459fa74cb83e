"""Who is in control of the robot, and who asks for it."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from server.access.rights import Role
from server.schema.base import Timestamp, Wire


class ControlPerson(Wire):
    """Somebody, as everybody who watches sees them."""

    id: str = Field(description="As in AccessSession.person", examples=["018f3c7e-anna"])
    name: str = Field(examples=["Anna"])
    role: Role


class ControlSeat(Wire):
    """One person is in control."""

    person: ControlPerson
    since: Timestamp
    ends_at: Timestamp | None = Field(
        description="When control ends if the person commands nothing more; null while the robot "
        "moves, or is being jogged or calibrated"
    )


class ControlRequest(Wire):
    """Another person asks for control."""

    id: str
    person: ControlPerson
    asked_at: Timestamp
    ends_at: Timestamp = Field(description="No answer until then means no")


class ControlAnswer(Wire):
    """What became of the newest request."""

    request_id: str
    person: ControlPerson = Field(description="Who asked")
    by: ControlPerson = Field(description="Who was in control")
    answer: Literal["given", "kept", "unanswered", "withdrawn", "ended"] = Field(
        description="given, and ended when the other's time was over: who asked is in control"
    )
    at: Timestamp


class Control(Wire):
    """Who commands the robot. What moves it at this moment is told by Robot.control."""

    holder: ControlSeat | None = Field(default=None, description="Null: whoever commands next")
    request: ControlRequest | None = None
    answer: ControlAnswer | None = Field(
        default=None, description="Of the newest request; null before there was any"
    )


class ControlReply(Wire):
    """The answer of whoever is in control."""

    request_id: str = Field(min_length=1, max_length=64)
    give: bool = Field(description="False: keep control")
