"""Errors become problem documents (RFC 9457)."""

from __future__ import annotations

from server.api.schema.problem import Problem
from server.errors import PlugPilotError

TYPE_PREFIX = "urn:plugpilot:problem:"


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
