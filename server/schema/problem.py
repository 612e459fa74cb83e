"""RFC 9457 problem documents."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from server.errors import PlugPilotError
from server.schema.base import Wire

TYPE_PREFIX = "urn:plugpilot:problem:"


class Problem(Wire):
    """What went wrong, in words a person can act on (application/problem+json)."""

    type: str = Field(examples=["urn:plugpilot:problem:control_busy"])
    title: str = Field(description="Short, the same for every occurrence of the code")
    status: int = Field(ge=400, le=599, description="HTTP status")
    code: str = Field(description="Stable, for programs", examples=["control_busy"])
    detail: str = Field(description="This occurrence, in a sentence")
    remedy: str = Field(description="What a person can do about it")
    context: dict[str, Any] = Field(
        default_factory=dict, description="Facts of this occurrence, by name with unit"
    )


def problem_from(error: PlugPilotError) -> Problem:
    """The problem document of an error."""
    return Problem(
        type=TYPE_PREFIX + error.code,
        title=error.title,
        status=error.status,
        code=error.code,
        detail=error.detail,
        remedy=error.remedy,
        context=error.context,
    )
