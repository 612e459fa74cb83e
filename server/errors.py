"""Errors that a person gets to see: each has a stable code and says what to do.

PlugPilotError
├── InternalError: nobody thought of it; look into the log
├── control (server/control/errors.py): who may move, and when
├── jobs (server/jobs/errors.py): what a job cannot do
├── localisation (server/localisation/errors.py): where the socket is, or is not
├── storage (server/storage/errors.py): what cannot be kept
└── api (server/api/errors.py): what a request got wrong

An error class names its code, its title, the HTTP status it becomes and the remedy; an instance
adds the sentence about this occurrence and the facts of it.
"""

from __future__ import annotations

from typing import Any, ClassVar


class PlugPilotError(Exception):
    """Base of all errors that are meant for people.

    Args:
        detail: What happened this time, in a sentence.
        context: Facts by name with unit, such as ``excess_mm``.
    """

    code: ClassVar[str] = "error"
    title: ClassVar[str] = "Something went wrong"
    status: ClassVar[int] = 500
    remedy: ClassVar[str] = "Try again."

    def __init__(self, detail: str, **context: Any) -> None:  # noqa: ANN401 - plain JSON values
        super().__init__(detail)
        self.detail = detail
        self.context: dict[str, Any] = context


class InternalError(PlugPilotError):
    """Something went wrong that nobody thought of; the log has the details."""

    code = "internal"
    title = "Something went wrong inside PlugPilot"
    remedy = "Look at the robot, then try again. If it happens again, restart PlugPilot."
