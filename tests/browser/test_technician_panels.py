"""Every panel of the technician's page opened: readable for all, in four languages."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.axe import violations_by_day_and_night
from tests.browser.bench_scenes import CALIBRATIONS, OPENED, PANELS, open_panel, updated
from tests.browser.chromium import PHONE
from tests.browser.languages import LOCALES, overflows
from tests.browser.scenes import SCENES
from tests.browser.stage import Stage

NARROW_PX = 320
CURVES = 4 + 2 + 2
"""Canvases: of the robot, of its link, of its camera."""


@contextmanager
def _bench(
    browser: Browser,
    address: str,
    *,
    width: int = PHONE["width"],
    locale: str = "en-GB",
) -> Iterator[Page]:
    """The page on a phone; it may not meet a single script error."""
    context = browser.new_context(
        viewport={"width": width, "height": PHONE["height"]},
        color_scheme="light",
        locale=locale,
        reduced_motion="reduce",
    )
    page = context.new_page()
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(f"{address}/technician")
    page.locator(".link[data-link=live]").wait_for()
    yield page
    context.close()
    assert errors == []


def _open_all(page: Page) -> None:
    for title in PANELS:
        open_panel(page, title)
    page.locator(".calibration :is(.calibration-starts, .calibration-actions)").first.wait_for()
    page.locator(".config-form").wait_for()
    page.locator(".console-frames strong").first.wait_for()
    expect(page.locator(".curves canvas")).to_have_count(CURVES)
    page.locator(".camera-overlay").wait_for()
    page.locator(".diagnostics-versions").wait_for()


def test_every_panel_is_accessible(browser: Browser, address: str, stage: Stage) -> None:
    stage.live = SCENES["ready"]
    with _bench(browser, address) as page:
        _open_all(page)
        assert violations_by_day_and_night(page) == []
        page.locator(".calibration-start").first.click()
        page.locator(".calibration-guide").wait_for()
        page.locator(".diagnostics-news summary").click()
        page.locator(".diagnostics-news li").first.wait_for()
        assert violations_by_day_and_night(page) == []
        updated(page)
        assert violations_by_day_and_night(page) == []


@pytest.mark.parametrize("scene", CALIBRATIONS)
def test_every_state_of_a_calibration_is_accessible(
    browser: Browser, address: str, stage: Stage, scene: str
) -> None:
    stage.live, opened = OPENED[scene]
    with _bench(browser, address) as page:
        opened(page)
        assert violations_by_day_and_night(page) == []
        for target in page.locator(".calibration button").all():
            box = target.bounding_box()
            assert box is not None
            assert box["height"] >= 44


@pytest.mark.parametrize("language", LOCALES)
def test_nothing_runs_over_in_any_language(
    browser: Browser, address: str, stage: Stage, language: str
) -> None:
    stage.live = SCENES["ready"]
    troubles: dict[str, list[str]] = {}
    with _bench(browser, address, width=NARROW_PX, locale=LOCALES[language]) as page:
        assert page.evaluate("document.documentElement.lang") == language
        _open_all(page)
        troubles["all panels"] = overflows(page)
        for number in range(page.locator(".calibration-start").count()):
            page.locator(".calibration-start").nth(number).click()
            page.locator(".calibration-guide").wait_for()
            troubles[f"guide {number}"] = overflows(page)
            page.locator(".calibration-actions .button").last.click()
            page.locator(".calibration-starts").first.wait_for()
        page.locator(".diagnostics-news summary").click()
        updated(page)
        troubles["updated"] = overflows(page)
        for name, live in CALIBRATIONS.items():
            stage.live = live
            expect(page.locator(".calibration")).to_have_count(1)
            page.evaluate("() => { localStorage.clear(); sessionStorage.clear(); }")
            page.reload()
            page.locator(".link[data-link=live]").wait_for()
            OPENED[name][1](page)
            troubles[name] = overflows(page)
    assert {name: found for name, found in troubles.items() if found} == {}
