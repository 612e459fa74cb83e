"""Measuring the belts in a browser: the robot asks, and goes on when it has its answer."""

from __future__ import annotations

from playwright.sync_api import Browser, expect

from tests.browser.bench_scenes import CALIBRATIONS, LEFT, MARKED, belts
from tests.browser.chromium import PHONE
from tests.browser.scenes import SCENES
from tests.browser.stage import Stage

BEGIN, CONFIRM = "/api/v1/calibrations/routine", "/api/v1/calibrations/routine/confirm"


def test_belts_are_measured_by_answering(browser: Browser, address: str, stage: Stage) -> None:
    stage.live = SCENES["ready"]
    context = browser.new_context(
        viewport={"width": PHONE["width"], "height": PHONE["height"]},
        locale="de-CH",
        reduced_motion="reduce",
    )
    page = context.new_page()
    page.goto(f"{address}/technician")
    page.locator(".link[data-link=live]").wait_for()
    page.get_by_text("Kalibrierung", exact=True).click()
    page.get_by_role("button", name="Weg der Riemen").click()
    with page.expect_request(f"**{BEGIN}") as begun:
        page.get_by_role("button", name="An die erste Stelle").click()
    assert begun.value.post_data_json == {
        "kind": "belts", "distance_mm": 300, "reading_sigma_mm": 0.1,
    }  # fmt: skip

    stage.live = belts(MARKED, 1)
    expect(page.get_by_text("Bis Sie antworten, bewegt sich nichts.")).to_be_visible()
    with page.expect_request(f"**{CONFIRM}") as marked:
        page.get_by_role("button", name="Fertig, weiter").click()
    assert marked.value.post_data_json == {"code": MARKED.code, "value": None}

    stage.live = belts(LEFT, 2)
    reading, enter = page.get_by_label("Ablesung, mm"), page.get_by_role("button", name="Eintragen")
    reading.fill("30,07")
    expect(enter).to_be_disabled()
    expect(page.get_by_role("button", name="Beenden")).to_be_enabled()
    reading.fill("300,7")
    with page.expect_request(f"**{CONFIRM}") as read:
        reading.press("Enter")
    assert read.value.post_data_json == {"code": LEFT.code, "value": 300.7}

    stage.live = CALIBRATIONS["calibration-result"]
    expect(page.get_by_role("button", name="Benutzen", exact=True)).to_be_visible()
    context.close()
