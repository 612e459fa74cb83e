"""A server that dies at any entry of its journal finishes the job in its next life.

Each piece of work for the database may be the last one, just before it and just after it, with and
without a power cut of the whole house. The garage, the board and the station are never reset. Here
a part of them; ``python -m tests.campaign.kill.entries`` takes all.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.support.killing.lives import die_at_entry


@pytest.fixture
def folder() -> Iterator[Path]:
    """Not ``tmp_path``: on a real disk each commit waits for it."""
    with tempfile.TemporaryDirectory(dir="/dev/shm") as name:
        yield Path(name)


@pytest.mark.parametrize(
    ("kind", "when", "dark", "first", "step"),
    [
        ("charge", "before", False, 2, 3),
        ("charge", "after", True, 4, 3),
        ("plug_in", "after", False, 3, 5),
        ("unplug", "after", False, 3, 4),
        ("unplug", "before", True, 5, 4),
    ],
)
def test_every_entry_of_the_journal_may_be_the_last_one(
    kind: str, when: str, first: int, step: int, folder: Path, *, dark: bool
) -> None:
    number = first
    here = folder / "0"
    while die_at_entry(kind, when, number, here, dark=dark):
        number += step
        here = folder / str(number)
    assert number > 10
