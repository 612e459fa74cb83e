"""What each release brought, as the change log tells it."""

from __future__ import annotations

import re
from datetime import date
from pathlib import Path

from server.schema.versions import Release

CHANGE_LOG = Path(__file__).parents[1] / "CHANGELOG.md"
_HEADING = re.compile(r"^## (\S+) \((\d{4}-\d{2}-\d{2})\)$", re.MULTILINE)
_CHANGE = re.compile(r"^- (.+(?:\n  .+)*)", re.MULTILINE)


def releases(text: str | None = None) -> list[Release]:
    """All releases, the newest first.

    Args:
        text: A change log: each release under a heading `## 1.2.0 (2026-11-22)`, its changes as a
            list; the one that came with this software when left out.
    """
    log = CHANGE_LOG.read_text(encoding="utf-8") if text is None else text
    _, *parts = _HEADING.split(log)
    return [
        Release(
            version=version,
            released_on=date.fromisoformat(released_on),
            changes=[" ".join(change.split()) for change in _CHANGE.findall(body)],
        )
        for version, released_on, body in zip(parts[::3], parts[1::3], parts[2::3], strict=True)
    ]
