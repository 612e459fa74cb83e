"""Journals of jobs that nobody has run."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime, timedelta
from typing import Any

from server.jobs.model import JobPhase
from server.schema.jobs import JobEvent

BEGAN = datetime(2026, 3, 1, 18, 0, tzinfo=UTC)

Entry = tuple[float, str, JobPhase]
"""Seconds since the job began, kind, phase."""


def journal(entries: Sequence[Entry], **data: Any) -> list[JobEvent]:  # noqa: ANN401 - JSON
    """A journal with these entries.

    Args:
        entries: Oldest first.
        data: Of every entry.
    """
    return [
        JobEvent(
            sequence=number,
            at=BEGAN + timedelta(seconds=at_s),
            kind=kind,
            phase=phase,
            message="",
            data=data,
        )
        for number, (at_s, kind, phase) in enumerate(entries, 1)
    ]
