"""What the change log says of the releases."""

from __future__ import annotations

import tomllib
from datetime import date
from itertools import pairwise
from pathlib import Path

from server.technician.changes import releases

PROJECT = Path(__file__).parents[3] / "pyproject.toml"


def test_a_log_is_taken_apart() -> None:
    log = """# What is new

Words.

## 1.2.0 (2027-01-02)

- Moves faster.
- Says in a long sentence that
  goes on, what it does.

## 1.1.0 (2026-12-24)

- First.
"""
    newest, oldest = releases(log)
    assert (newest.version, newest.released_on) == ("1.2.0", date(2027, 1, 2))
    assert newest.changes == [
        "Moves faster.",
        "Says in a long sentence that goes on, what it does.",
    ]
    assert oldest.changes == ["First."]


def test_this_version_has_its_entry_and_the_newest_comes_first() -> None:
    found = releases()
    assert found[0].version == tomllib.loads(PROJECT.read_text())["project"]["version"]
    assert all(release.changes for release in found)
    assert all(later.released_on >= earlier.released_on for later, earlier in pairwise(found))
