"""What no file of the project may contain, whatever its language."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

PROJECT = Path(__file__).parents[1]
LONGEST_SOURCE = 350
SOURCES = {".py", ".ts", ".tsx", ".css", ".c", ".h", ".cpp", ".hpp"}
GENERATED = {
    "web/src/api/schema.ts",
    "drivers/arduino/protocol/messages.py",
    "drivers/arduino/firmware/core/protocol.hpp",
}

UNWANTED = {
    # The lock files work with any mirror; a host in them would tie the project to one.
    "the host of a package registry": (
        r"(pypi|pythonhosted|npmjs|yarnpkg|crates|debian)\.(org|io|com)"
    ),
    "a path of one machine": r"(?<![\w.])/(root|work|home/\w+|Users/\w+)/",
    "a mark of something unfinished": r"\b(TO[D]O|FIX[M]E|XX[X])\b",
    "a conflict mark": r"^(<{7}|>{7}) ",
}


def project_files() -> list[Path]:
    """Files that are under version control or about to be."""
    listing = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=PROJECT,
        capture_output=True,
        check=True,
    )
    paths = [PROJECT / name for name in listing.stdout.decode().split("\0") if name]
    return [path for path in paths if path.is_file()]


def text_of(path: Path) -> str:
    """The text of a file; of a picture or another binary file, nothing."""
    content = path.read_bytes()
    return "" if b"\0" in content else content.decode("utf-8")


@pytest.mark.parametrize("what", UNWANTED)
def test_no_file_contains(what: str) -> None:
    pattern = re.compile(UNWANTED[what], re.MULTILINE)
    found = [
        f"{path.relative_to(PROJECT)}:{text.count(chr(10), 0, match.start()) + 1}: {match.group()}"
        for path in project_files()
        for text in [text_of(path)]
        for match in pattern.finditer(text)
    ]
    assert not found, "\n".join([f"{what}:", *found])


@pytest.mark.parametrize(
    ("what", "text"),
    [
        ("the host of a package registry", "https://registry.npmjs" + ".org/preact"),
        ("a path of one machine", "see /ro" + "ot/notes.txt"),
        ("a mark of something unfinished", "# TO" + "DO: later"),
        ("a conflict mark", "<" * 7 + " HEAD"),
    ],
)
def test_the_patterns_find_what_they_are_for(what: str, text: str) -> None:
    assert re.search(UNWANTED[what], text, re.MULTILINE)


def test_source_files_are_short_enough_to_have_one_subject() -> None:
    lengths = {
        str(path.relative_to(PROJECT)): text_of(path).count("\n")
        for path in project_files()
        if path.suffix in SOURCES
    }
    assert len(lengths) > 50, "the sources were not found"
    long = {n: k for n, k in lengths.items() if k > LONGEST_SOURCE and n not in GENERATED}
    assert not long, f"longer than {LONGEST_SOURCE} lines: {long}"
