"""Every remark on a calibration is known to the pages, which say it in four languages."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
CALIBRATION = ROOT / "server" / "calibration"
JUDGES = (
    *sorted(CALIBRATION.glob("*/verdict.py")),
    CALIBRATION / "routines" / "robot_result.py",
)
LANGUAGES = ("de", "fr", "it")
PAGE = ROOT / "web" / "src" / "calibration" / "translated.ts"
SHORTEST = 25


def _patterns() -> dict[str, re.Pattern[str]]:
    text = PAGE.read_text(encoding="utf-8")
    table = text.split("const REMARKS", 1)[1].split("} as const", 1)[0]
    found = dict(re.findall(r"^  (\w+): /(.+)/,$", table, flags=re.MULTILINE))
    found |= dict(re.findall(r"^const (FAR|UNSEEN) = /(.+)/;$", text, flags=re.MULTILINE))
    return {name: re.compile(pattern) for name, pattern in found.items()}


def _shown(value: ast.expr) -> str:
    """A value that stands in a sentence, as it might be shown."""
    match value:
        case ast.IfExp(body=ast.Constant(value=str(word))):
            return word
        case ast.Name(id="carriage"):
            return "left"
        case _:
            return "1"


def _sentence(node: ast.expr) -> str | None:
    match node:
        case ast.Constant(value=str(text)):
            return text
        case ast.JoinedStr(values=parts):
            return "".join(
                _shown(part.value) if isinstance(part, ast.FormattedValue) else str(part.value)
                for part in parts
                if isinstance(part, ast.FormattedValue | ast.Constant)
            )
        case _:
            return None


def _remarks(path: Path) -> Iterator[str]:
    """Sentences of a module that are neither its docstrings nor parts of other sentences."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    told = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    parts = {
        id(part) for node in ast.walk(tree) if isinstance(node, ast.JoinedStr)
        for part in ast.walk(node) if part is not node
    }  # fmt: skip
    for node in ast.walk(tree):
        if isinstance(node, ast.expr) and id(node) not in told | parts:
            text = _sentence(node)
            if text and len(text) >= SHORTEST and text[0].isupper() and text.endswith("."):
                yield text


@pytest.mark.parametrize("path", JUDGES, ids=lambda path: path.relative_to(CALIBRATION).as_posix())
def test_every_remark_is_known(path: Path) -> None:
    patterns = _patterns()
    remarks = list(_remarks(path))
    assert remarks, "this module makes no remark any more"
    unknown = [one for one in remarks if not any(p.search(one) for p in patterns.values())]
    assert unknown == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_known_remark_is_said(language: str) -> None:
    said = (ROOT / "web" / "src" / "technician" / "language" / language / "said.ts").read_text(
        encoding="utf-8"
    )
    names = {name for name in _patterns() if name.islower() or not name.isupper()}
    assert {name for name in names if not re.search(rf"^  {name}: ", said, re.MULTILINE)} == set()
