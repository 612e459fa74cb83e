"""What the panels of the technician's page are shown, and how each is opened."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from playwright.sync_api import Page

from server.calibration.accuracy.iso9283 import place_result
from server.calibration.grade import Grade
from server.calibration.routines.check_record import with_verdict
from server.schema.accuracy import AccuracyCheck, AccuracyCheckPage, CheckedPlace
from server.schema.calibrations import (
    Calibration,
    CalibrationDetail,
    CalibrationKind,
    ForceValues,
    LookRecord,
)
from server.schema.drift import MaintenanceHint
from server.schema.live import Live
from server.schema.problem import Problem
from server.schema.routines import (
    CalibrationNow,
    Routine,
    RoutineFigure,
    RoutineInput,
    RoutineLook,
    RoutineQuestion,
)
from tests.browser import board_scene, health_scenes
from tests.browser.scenes import SCENES

Json = Any
_OPENAPI = Path(__file__).resolve().parents[2] / "web" / "openapi.json"
_UNSEEN = (
    "The length of the left leg and the length of the right leg: the looks say little about that, "
    "and what was known before is kept."
)
_EDGES = (
    "At the edges of the workspace the plug may still be 0.31 mm off: measure the belts over 400 "
    "mm and the label with a calliper, let the label be near the middle of the workspace, and "
    "repeat."
)
_REMARK = (
    "Places that were held back are missed by 0.12 mm; a good robot manages 0.06 mm. Tighten the "
    "belts and repeat."
)


@cache
def _examples() -> dict[str, Json]:
    """Published answers to GET, by the path."""
    paths = json.loads(_OPENAPI.read_text(encoding="utf-8"))["paths"]
    content = {
        path: methods["get"]["responses"]["200"].get("content", {}).get("application/json", {})
        for path, methods in paths.items()
        if "get" in methods
    }
    return {path: found["example"] for path, found in content.items() if "example" in found}


def _example(path: str) -> Json:
    return _examples()[f"/api/v1/{path}"]


def _detail() -> CalibrationDetail:
    """A version that is usable, with a look at each of 25 places."""
    example = CalibrationDetail.model_validate(_example("calibrations/{calibration_id}"))
    assert example.evidence is not None
    rng = np.random.default_rng(7)
    (look,) = example.evidence.looks
    looks = [
        LookRecord(
            **{
                **dict(look),
                "rho1_mm": float(rho[0]),
                "rho2_mm": float(rho[1]),
                "residual_mm": tuple(rng.normal(0.0, 0.05, 3).tolist()),
                "weight": 0.2 if number == 11 else 1.0,
            }
        )
        for number, rho in enumerate(rng.uniform(60.0, 360.0, (25, 2)))
    ]
    doubt = {"tip_likely_mm": 0.12, "tip_at_most_mm": 0.31}
    evidence = example.evidence.model_copy(update={"looks": looks, "unseen": [_UNSEEN], **doubt})
    changes = {
        "evidence": evidence,
        "grade": Grade.USABLE,
        "remarks": [_REMARK, _EDGES],
        "in_force": False,
    }
    return example.model_copy(update=changes)


SLIDE = "slide"
"""Id of the version that has measured the slide."""


def _slide() -> CalibrationDetail:
    """A slide that wants grease; the scale was measured against a spring."""
    values = ForceValues(
        friction_n=6.3, friction_sigma_n=0.12, offset_n=-0.4, offset_sigma_n=0.1, scale=1.03,
        scale_sigma=0.02, following_mm=0.21,
    )  # fmt: skip
    changes = {
        "id": SLIDE, "kind": CalibrationKind.FORCE, "values": values, "evidence": None,
        "grade": Grade.USABLE, "error": 0.31, "error_in_use": 6.5, "in_force": False,
        "remarks": ["The slide takes 6.3 N to move freely: clean and grease its screw."],
    }  # fmt: skip
    return _detail().model_copy(update=changes)


def _checks() -> AccuracyCheckPage:
    """Two checks at nine places, the newer one better, though there is play."""
    (example,) = AccuracyCheckPage.model_validate(_example("calibrations/checks")).items
    rng = np.random.default_rng(7)

    def place(x_mm: float, y_mm: float) -> CheckedPlace:
        below, above = (
            np.array([x_mm + 0.24, y_mm + 0.21 + side]) + rng.normal(0.0, 0.01, (3, 2))
            for side in (-0.17, 0.17)
        )
        found = place_result(np.array([x_mm, y_mm]), {"below": below, "above": above})
        return CheckedPlace(
            x_mm=x_mm,
            y_mm=y_mm,
            accuracy_mm=found.accuracy_mm,
            repeatability_mm=found.repeatability_mm,
            direction_variation_mm=found.direction_variation_mm,
            attained_mm=[(float(x), float(y)) for x, y in (*below, *above)],
        )

    places = [place(x, y) for y in (240.0, 335.0, 430.0) for x in (460.0, 650.0, 840.0)]
    worst = {
        name: max(getattr(one, name) for one in places)
        for name in ("accuracy_mm", "repeatability_mm", "direction_variation_mm")
    }
    new = with_verdict(AccuracyCheck(**{**dict(example), "places": places, **worst}))
    assert new.verdict is Grade.USABLE
    before = {"id": "before", "calibration_id": None, "accuracy_mm": 2.3, "verdict": Grade.BAD}
    return AccuracyCheckPage(items=[new, new.model_copy(update=before)])


def answer(path: str) -> Json:
    """What the server would say to a GET; None where nothing is published."""
    if path in health_scenes.NEXT:
        return health_scenes.NEXT[path](_example(path))
    if path == "calibrations/checks":
        return _checks().model_dump(mode="json")
    if path == "calibrations":
        older = Calibration.model_validate(_example("calibrations")["items"][0])
        newest = Calibration(
            **{name: getattr(_detail(), name) for name in Calibration.model_fields}
        )
        newest = newest.model_copy(update={"id": "01957a40-0000-7000-8000-000000000002"})
        newest = newest.model_copy(update={"version": 4})
        page = [one.model_dump(mode="json") for one in (newest, older)]
        return {"items": page, "next_cursor": None}
    if path == "calibrations/routine/board":
        return board_scene.look().model_dump(mode="json")
    if path == f"calibrations/{board_scene.CAMERA}":
        return board_scene.version(_detail()).model_dump(mode="json")
    if path == f"calibrations/{SLIDE}":
        return _slide().model_dump(mode="json")
    if path.startswith("calibrations/"):
        return _detail().model_dump(mode="json")
    return _examples().get(f"/api/v1/{path}")


def picture() -> bytes:
    """A picture of the camera's size, with nothing in it."""
    grey = np.full((1232, 1640), 96, np.uint8)
    return bytes(cv2.imencode(".jpg", grey)[1])


def _calibrating(**changes: object) -> Live:
    now = CalibrationNow.model_validate(_example("calibrations/now"))
    assert now.routine is not None
    rng = np.random.default_rng(3)
    looks = [
        RoutineLook(x_mm=float(x), y_mm=float(y), seen=number != 5)
        for number, (x, y) in enumerate(rng.uniform((450, 220), (850, 440), (12, 2)))
    ]
    running = {
        "state": "running", "doing": "Looking at the label from many places.", "done": 12,
        "looks": looks, "calibration_id": None,
    }  # fmt: skip
    routine = Routine(**{**dict(now.routine), **running, **changes})
    calibration = now.model_copy(update={"routine": routine})
    return SCENES["ready"].model_copy(update={"calibration": calibration})


_LOST = Problem(
    type="urn:plugpilot:problem:calibration_label_lost",
    title="The label was seen too seldom",
    status=409,
    code="calibration_label_lost",
    detail="From the first place the label is not to be seen any more.",
    remedy="Look for glare, dirt and things in front of the label, then go on.",
)
_MOVED = _LOST.model_copy(update={"code": "calibration_label_moved", "context": {"moved_mm": 1.24}})

MARKED = RoutineQuestion(
    code="belts_marked",
    text="Mark on the rail where both carriages stand, then confirm.",
    input=None,
)
LEFT = RoutineQuestion(
    code="belts_left",
    text="How far has the left carriage gone from its mark?",
    input=RoutineInput(unit="mm", least=285.0, most=315.0),
)


def belts(asks: RoutineQuestion, done: int) -> Live:
    """The belts are being measured, and the robot waits for an answer."""
    return _calibrating(kind="belts", asks=asks, done=done, total=2, looks=[])


def _force_found() -> Live:
    figures = [
        RoutineFigure(code="friction_n", label="Friction", value=6.3, sigma=0.12, unit="N"),
        RoutineFigure(code="force_scale", label="Force scale", value=1.03, sigma=0.02, unit=""),
    ]
    return _calibrating(
        kind="force", state="finished", calibration_id=SLIDE, looks=[], figures=figures
    )


def _worn() -> Live:
    """The belts have moved further than was proven, and a socket's label has come loose."""
    now = CalibrationNow.model_validate(_example("calibrations/now"))
    off = MaintenanceHint(
        code="socket_off",
        title="The socket is not where its label says",
        text="The last plugs went in +1.2 mm to the right and -0.4 mm up from there. Look whether "
        "the label of Renault Zoe has come loose, then teach the socket again.",
        vehicle_id="zoe",
    )
    worn = now.model_copy(update={"routine": None, "hints": [*now.hints, off]})
    return SCENES["ready"].model_copy(update={"calibration": worn})


CALIBRATIONS: Mapping[str, Live] = {
    "calibration-board": _calibrating(
        kind="camera",
        asks=board_scene.ENOUGH,
        done=11,
        total=17,
        looks=[],
        doing="Watching for the board.",
    ),
    "calibration-camera": _calibrating(
        kind="camera",
        state="finished",
        calibration_id=board_scene.CAMERA,
        looks=[],
        figures=board_scene.FIGURES,
    ),
    "calibration-marking": belts(MARKED, 1),
    "calibration-reading": belts(LEFT, 2),
    "calibration-slide": _force_found(),
    "calibration-worn": _worn(),
    "calibration-running": _calibrating(),
    "calibration-interrupted": _calibrating(state="interrupted", problem=_LOST),
    "calibration-failed": _calibrating(state="failed", problem=_MOVED),
    "calibration-result": _calibrating(state="finished", calibration_id=_detail().id, done=25),
    "calibration-checked": _calibrating(
        kind="check", state="finished", check_id=_example("calibrations/checks")["items"][0]["id"]
    ),
}


def open_panel(page: Page, title: str) -> None:
    """Open a panel, unless it has opened by itself."""
    panel = page.locator("details.panel").nth(PANELS.index(title))
    panel.evaluate("panel => { panel.open = true; }")


PANELS = ("calibration", "target", "link", "console", "camera", "configuration", "diagnostics")
"""The panels in the order of the page."""


def _calibration(page: Page) -> None:
    open_panel(page, "calibration")
    page.locator(".calibration :is(.calibration-starts, .calibration-actions)").first.wait_for()


def _guide(page: Page) -> None:
    _calibration(page)
    page.locator(".calibration-start").nth(1).click()
    page.locator(".calibration-guide").wait_for()


def _camera_guide(page: Page) -> None:
    _calibration(page)
    page.locator(".calibration-start").first.click()
    page.locator(".calibration-guide").wait_for()


def _force_guide(page: Page) -> None:
    _calibration(page)
    page.locator(".calibration-start").nth(5).click()
    page.locator(".calibration-guide").wait_for()


def _board(page: Page) -> None:
    _calibration(page)
    page.locator(".board-overlay").wait_for()


def _news(page: Page) -> None:
    open_panel(page, "diagnostics")
    page.locator(".diagnostics-news summary").click()
    page.locator(".diagnostics-news li").first.wait_for()


def updated(page: Page) -> None:
    """The page is loaded anew in a browser that was here before an update."""
    page.evaluate("localStorage.setItem('plugpilot.version.seen', '0.0.9')")
    page.reload()
    page.locator(".updated").wait_for()


def _to_panel(title: str) -> Callable[[Page], None]:
    def opened(page: Page) -> None:
        open_panel(page, title)
        health_scenes.fill_curves(page, title)

    return opened


OPENED: Mapping[str, tuple[Live, Callable[[Page], None]]] = {
    "calibration": (SCENES["ready"], _calibration),
    "calibration-guide": (SCENES["ready"], _guide),
    "calibration-guide-camera": (SCENES["ready"], _camera_guide),
    "calibration-guide-force": (SCENES["ready"], _force_guide),
    "news": (SCENES["ready"], _news),
    **{name: (live, _calibration) for name, live in CALIBRATIONS.items()},
    "calibration-board": (CALIBRATIONS["calibration-board"], _board),
    **{title: (SCENES["ready"], _to_panel(title)) for title in PANELS[1:]},
}
"""What is opened on the technician's page, each with the state it is opened in."""
