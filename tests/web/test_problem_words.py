"""The pages translate problems by their codes: those have to be the server's."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from drivers.robot import FaultCode
from server.access import errors as access
from server.calibration.camera import errors as camera
from server.calibration.robot import errors as looks
from server.calibration.routines import errors as routines
from server.calibration.versions import errors as versions
from server.charge_point import errors as charge_point
from server.control import errors as control
from server.control.trouble import _BY_CODE as BOARD_TROUBLES
from server.errors import InternalError, PlugPilotError
from server.jobs import errors as jobs
from server.localisation import errors as localisation
from server.push import errors as push
from server.recordings import errors as recordings

WEB = Path(__file__).resolve().parents[2] / "web" / "src"
LANGUAGE = WEB / "language"
BENCH = WEB / "technician" / "language" / "told.ts"
DOINGS = WEB / "calibration" / "translated.ts"
ROOMS = (access, charge_point, control, jobs, localisation, push, recordings)
OF_PROGRAMS = {"idempotency_key_reused", "cancelled", "people_only"}
"""Nobody sees these: the page makes its keys itself, a cancelled job is no failure, and whoever
sees a page is a person."""


def _kinds(kind: type[PlugPilotError]) -> Iterator[type[PlugPilotError]]:
    yield kind
    for each in kind.__subclasses__():
        yield from _kinds(each)


def _listed(file: Path = LANGUAGE / "problems.ts") -> set[str]:
    text = file.read_text(encoding="utf-8")
    table = re.search(r"PROBLEM_CODES = \[(.*?)\]", text, re.DOTALL)
    assert table is not None
    return set(re.findall(r'"(\w+)"', table[1]))


def test_every_problem_of_the_home_page_is_translated() -> None:
    rooms = {room.__name__ for room in ROOMS}
    shown = {kind.code for kind in _kinds(PlugPilotError) if kind.__module__ in rooms}
    shown |= {code.value for code in FaultCode} | set(BOARD_TROUBLES) | {InternalError.code}
    shown -= OF_PROGRAMS | {"interruption"}
    assert shown - _listed() == set()


def test_every_problem_of_calibration_is_translated_for_technicians() -> None:
    rooms = {room.__name__ for room in (camera, looks, routines, versions)}
    shown = {kind.code for kind in _kinds(PlugPilotError) if kind.__module__ in rooms}
    assert shown - _listed(BENCH) == set()


def test_every_sentence_of_a_routine_is_translated() -> None:
    """What is not in the list stays in English: a new sentence belongs there."""
    folder = WEB.parents[1] / "server" / "calibration" / "routines"
    source = "".join(path.read_text(encoding="utf-8") for path in folder.glob("*.py"))
    said = set(re.findall(r'(?:progress\.say\(|\.doing = |doing: str = )"([^"]+)"', source))
    listed = set(re.findall(r': "([^"]+\.)",', DOINGS.read_text(encoding="utf-8")))
    assert said == listed


def test_every_counted_sentence_of_a_routine_is_known_by_its_beginning() -> None:
    folder = WEB.parents[1] / "server" / "calibration" / "routines"
    source = "".join(path.read_text(encoding="utf-8") for path in folder.glob("*.py"))
    said = set(re.findall(r'progress\.say\(\s*f"([^"{]+)\{', source))
    counted = DOINGS.read_text(encoding="utf-8").split("const COUNTED")[1].split("as const")[0]
    assert said == set(re.findall(r": /\^([^(]+)\(", counted))


def test_every_question_of_a_routine_is_translated() -> None:
    folder = WEB.parents[1] / "server" / "calibration" / "routines"
    source = "".join(path.read_text(encoding="utf-8") for path in folder.glob("*_routine.py"))
    asked = set(re.findall(r'progress\.(?:confirm|number|offer)\(\s*f?"([^"]+)"', source))
    assert "belts_{name}" in asked
    asked = asked - {"belts_{name}"} | {"belts_left", "belts_right"}
    known = (WEB / "calibration" / "asked.ts").read_text(encoding="utf-8")
    assert asked == set(re.findall(r"^  (\w+): /", known, re.MULTILINE))


def test_every_hint_is_translated() -> None:
    folder = WEB.parents[1] / "server" / "calibration"
    source = "".join(path.read_text(encoding="utf-8") for path in folder.rglob("*.py"))
    given = set(re.findall(r'MaintenanceHint\(\s*code="(\w+)"', source))
    known = (WEB / "calibration" / "hinted.ts").read_text(encoding="utf-8")
    assert given == set(re.findall(r"^  (\w+): /", known, re.MULTILINE))


def test_nothing_is_translated_that_the_server_never_says() -> None:
    source = "".join(
        path.read_text(encoding="utf-8")
        for folder in ("server", "drivers")
        for path in (LANGUAGE.parents[2] / folder).rglob("*.py")
    )
    unknown = {code for code in _listed() | _listed(BENCH) if f'"{code}"' not in source}
    assert unknown == set()
