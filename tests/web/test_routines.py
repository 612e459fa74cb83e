"""The pages describe the routines themselves: in the server's order, with the server's limits."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from server.calibration.routines.described import ROUTINES
from server.schema.routines import RoutineDescription

PAGE = Path(__file__).resolve().parents[2] / "web" / "src" / "calibration" / "routines.ts"
PERCENT = {"spring_sigma"}
"""Typed in per cent, sent as a share."""
_REPEATED = 'path: ["approaches"], least: 3, most: 30, whole: true'


def _entries() -> dict[str, str]:
    text = PAGE.read_text(encoding="utf-8")
    assert _REPEATED in text
    table = text.split("export const ROUTINES", 1)[1].split("\n};", 1)[0]
    found = re.split(r"^  (\w+): \{", table.replace("...repeated", _REPEATED), flags=re.MULTILINE)
    return dict(zip(found[1::2], found[2::2], strict=True))


def test_the_page_has_them_in_the_order_a_new_robot_wants_them() -> None:
    assert list(_entries()) == [routine.kind for routine in ROUTINES]


@pytest.mark.parametrize("routine", ROUTINES, ids=lambda routine: routine.kind)
def test_the_page_has_the_limits_of_each(routine: RoutineDescription) -> None:
    entry = _entries()[routine.kind]
    assert f"needsLabel: {str(routine.needs_label).lower()}" in entry
    for setting in routine.settings:
        (field,) = re.findall(rf'\{{[^{{}}]*path: \["{setting.name}"\][^{{}}]*\}}', entry)
        factor = 100 if setting.name in PERCENT else 1
        limits = re.search(r"least: ([\d.]+), most: ([\d.]+)", field)
        initial = re.search(r"initial: (null|[\d.]+)", field)
        assert limits is not None
        assert initial is not None
        assert float(limits[1]) == pytest.approx(factor * setting.least)
        assert float(limits[2]) == pytest.approx(factor * setting.most)
        usual = "null" if setting.usual is None else f"{factor * setting.usual:g}"
        assert initial[1] == usual
        assert ("whole: true" in field) is setting.whole
