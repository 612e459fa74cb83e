"""Step by step when the robot needs a person: readable, accessible, and loaded only then."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.axe import violations
from tests.browser.guide_scenes import SCENES as STATES
from tests.browser.languages import LOCALES, overflows
from tests.browser.scenes import SCENES
from tests.browser.stage import Stage

NARROW = {"width": 320, "height": 640}
SCREENS = [{"width": 800, "height": 480}, {"width": 1024, "height": 600}]
ABOUT = {"unknown": "plug_unknown", "emergency": "emergency_stop"}


@pytest.fixture(scope="module", params=LOCALES)
def page(browser: Browser, request: pytest.FixtureRequest) -> Iterator[Page]:
    """The narrowest phone, in each language; by night in two of them."""
    context = browser.new_context(
        viewport={"width": NARROW["width"], "height": NARROW["height"]},
        locale=LOCALES[request.param],
        color_scheme="dark" if request.param in {"de", "it"} else "light",
        reduced_motion="reduce",
    )
    page = context.new_page()
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    yield page
    context.close()
    assert errors == []


def _open(page: Page) -> None:
    page.locator(".guide-button").click()
    page.get_by_role("dialog").wait_for()


def test_every_guide_is_accessible_and_fits(page: Page, address: str, stage: Stage) -> None:
    stage.live = SCENES["stopped"]
    page.goto(address)
    _open(page)
    guide = page.locator(".guide")
    troubles: dict[str, list[str]] = {}
    for name, state in STATES.items():
        stage.live = state
        expect(guide).to_have_attribute("data-about", ABOUT.get(name, name))
        drawings = page.locator(".guide li svg")
        assert 2 <= drawings.count() <= 4
        assert drawings.count() == page.locator(".guide li p").count()
        troubles[name] = overflows(page)
    troubles["axe"] = violations(page)
    assert {name: found for name, found in troubles.items() if found} == {}


def test_no_guide_is_loaded_before_it_is_asked_for(
    browser: Browser, address: str, stage: Stage
) -> None:
    stage.live = SCENES["needs_person"]
    page = browser.new_page()
    page.goto(address)
    page.locator(".guide-button").wait_for()
    page.wait_for_load_state("networkidle")
    before: list[str] = []
    page.on("request", lambda request: before.append(request.url))
    _open(page)
    assert any("/assets/dialog" in url for url in before)
    page.close()


def test_without_its_files_a_guide_says_so(browser: Browser, address: str, stage: Stage) -> None:
    stage.live = SCENES["needs_person"]
    # A service worker, once it is there, fetches around what a test puts in the way.
    page = browser.new_page(locale="en-GB", service_workers="block")
    page.route("**/assets/dialog*.js", lambda route: route.abort())
    page.goto(address)
    page.locator(".guide-button").click()
    expect(page.get_by_role("alert")).to_contain_text("No answer")
    page.close()


@pytest.mark.parametrize("size", SCREENS, ids=lambda size: f"{size['width']}x{size['height']}")
def test_on_a_small_screen_the_way_on_is_in_sight(
    browser: Browser, address: str, stage: Stage, size: dict[str, int]
) -> None:
    page = browser.new_page(
        viewport={"width": size["width"], "height": size["height"]}, locale="de-DE"
    )
    for name in ("emergency", "insertion_jammed"):
        stage.live = STATES[name]
        page.goto(address)
        _open(page)
        box = page.locator("dialog .button.primary").bounding_box()
        assert box is not None
        assert box["y"] + box["height"] <= size["height"], name
    page.close()
