"""The checked list names tests; each of them is there."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import server

PROJECT = Path(server.__file__).parents[1]
LIST = PROJECT / "server" / "access" / "SECURITY.md"
TEST = re.compile(r"`((?:[\w./]+/)?test_\w+\.py)(?:::(\w+))?`")
NAMED = sorted(set(TEST.findall(LIST.read_text())))


def test_the_list_names_tests() -> None:
    assert len(NAMED) > 40


@pytest.mark.parametrize(("file", "name"), NAMED)
def test_every_test_of_the_list_exists(file: str, name: str) -> None:
    path = PROJECT / file if "/" in file else PROJECT / "tests" / "server" / "access" / file
    content = path.read_text()
    assert name == "" or f"def {name}(" in content
