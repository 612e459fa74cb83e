"""The report of a nine-point check."""

from __future__ import annotations

from datetime import UTC, datetime

import httpx
import numpy as np

from server.calibration.report.accuracy_report import accuracy_report
from server.calibration.routines.check_record import check_of
from server.calibration.routines.check_routine import CheckResult, judged
from server.schema.accuracy import AccuracyCheck
from server.schema.routines import CheckRoutineRequest
from tests.server.calibration.robot.built import Workshop
from tests.server.calibration.routines.test_check_routine import looks
from tests.support.api import on_api, problem
from tests.support.garage import Scene

MADE_AT = datetime(2026, 3, 1, 18, 9, 40, tzinfo=UTC)


def a_check(left_out: int = 0) -> AccuracyCheck:
    robot = Workshop.robot(3)
    places = judged(looks(robot, robot.built), robot.R_base_camera)
    found = CheckResult(CheckRoutineRequest(), "Anna", places[left_out:], left_out, 141.2)
    return check_of(found, MADE_AT, None)


def test_the_same_check_gives_the_same_paper_and_another_another() -> None:
    check = a_check()
    paper = accuracy_report(check, None)
    assert paper.startswith(b"%PDF-")
    assert paper.rstrip().endswith(b"%%EOF")
    assert accuracy_report(check, None) == paper
    assert accuracy_report(a_check(left_out=2), None) != paper


def test_it_is_downloaded_as_long_as_the_check_is_kept() -> None:
    async def scenario(scene: Scene, client: httpx.AsyncClient) -> None:
        check = a_check()
        await scene.services.accuracy_checks.add(check)
        answer = await client.get(f"calibrations/checks/{check.id}/report.pdf")
        assert answer.status_code == 200
        assert answer.headers["content-type"] == "application/pdf"
        assert "plugpilot-check-20260301-180940.pdf" in answer.headers["content-disposition"]
        assert answer.content == accuracy_report(check, None)
        missing = await client.get("calibrations/checks/nothing/report.pdf")
        problem(missing, 404, "calibration_check_not_found")

    on_api(scenario, seed=2)


def test_means_of_a_place_are_those_of_all_approaches() -> None:
    place = a_check().places[0]
    mean = np.mean(place.attained_mm, axis=0)
    off = np.linalg.norm(mean - (place.x_mm, place.y_mm))
    np.testing.assert_allclose(off, place.accuracy_mm, atol=1e-9)
