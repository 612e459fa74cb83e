"""The home page in a real browser: accessible, within its budget, and safe to touch."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, Response, expect

from tests.browser.axe import violations_by_day_and_night
from tests.browser.chromium import DESKTOP, PHONE
from tests.browser.languages import overflows
from tests.browser.scenes import SCENES
from tests.browser.stage import Stage

LARGE_TEXT = "html { font-size: 200% }"

MAX_REQUESTS = 10
MAX_BYTES = 60_000
MIN_TARGET_PX = 44
MIN_STOP_PX = 64
MIN_AIR_PX = 24


@pytest.fixture(scope="module")
def page(browser: Browser) -> Iterator[Page]:
    """A phone, by day."""
    context = browser.new_context(
        viewport={"width": PHONE["width"], "height": PHONE["height"]},
        color_scheme="light",
        reduced_motion="reduce",
        has_touch=True,
        is_mobile=True,
    )
    page = context.new_page()
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    yield page
    context.close()
    assert errors == []


@pytest.fixture
def desktop(browser: Browser) -> Iterator[Page]:
    """A laptop."""
    page = browser.new_page(viewport={"width": DESKTOP["width"], "height": DESKTOP["height"]})
    yield page
    page.close()


def _open(page: Page, address: str, stage: Stage, scene: str) -> None:
    stage.live = SCENES[scene]
    stage.requests.clear()
    page.goto(address)
    page.locator(".link[data-link=live]").wait_for()


@pytest.mark.parametrize("scene", SCENES)
def test_every_state_is_accessible(page: Page, address: str, stage: Stage, scene: str) -> None:
    _open(page, address, stage, scene)
    assert violations_by_day_and_night(page) == []


def test_dialogs_and_details_are_accessible(page: Page, address: str, stage: Stage) -> None:
    _open(page, address, stage, "ready")
    page.locator(".robot summary").click()
    page.locator(".history summary").click()
    page.get_by_role("button", name="Watch again").wait_for()
    page.get_by_role("button", name="Emergency stop").wait_for()
    page.get_by_role("button", name="Charge", exact=True).click()
    page.get_by_role("dialog").wait_for()
    assert violations_by_day_and_night(page) == []


def test_a_recorded_job_can_be_watched_with_a_thumb(page: Page, address: str, stage: Stage) -> None:
    _open(page, address, stage, "ready")
    page.locator(".history summary").click()
    page.get_by_role("button", name="Watch again").click()
    page.get_by_role("slider", name="Time in the recording").wait_for()
    for target in page.locator("dialog button, dialog input").all():
        box = target.bounding_box()
        assert box is not None
        assert box["height"] >= MIN_TARGET_PX, target.inner_text()
        assert box["x"] + box["width"] <= PHONE["width"]
    assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
    assert violations_by_day_and_night(page) == []
    page.get_by_role("button", name="Close").click()
    expect(page.get_by_role("dialog")).to_have_count(0)


@pytest.mark.parametrize("scene", SCENES)
def test_nothing_is_too_small_or_too_wide(
    page: Page, address: str, stage: Stage, scene: str
) -> None:
    _open(page, address, stage, scene)
    for target in page.locator("button, summary").all():
        box = target.bounding_box()
        assert box is not None
        assert min(box["width"], box["height"]) >= MIN_TARGET_PX, target.inner_text()
    assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]


@pytest.mark.parametrize("scene", ["ready", "charging_priced", "needs_person", "failed"])
def test_text_may_be_twice_as_large(page: Page, address: str, stage: Stage, scene: str) -> None:
    _open(page, address, stage, scene)
    _enlarge(page)
    assert overflows(page) == []
    assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]


def test_text_of_the_bench_may_be_twice_as_large(page: Page, address: str, stage: Stage) -> None:
    stage.live = SCENES["ready"]
    page.goto(f"{address}/technician")
    page.locator(".link[data-link=live]").wait_for()
    _enlarge(page)
    table = r" (T[A-Z]*|SMALL)\."  # numbers side by side: these are pushed aside by a finger
    assert [each for each in overflows(page) if not re.search(table, each)] == []
    assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]


def _enlarge(page: Page) -> None:
    # Through the style sheet object: the page's own policy forbids a style element.
    page.evaluate(
        "(rule) => { const s = new CSSStyleSheet(); s.replaceSync(rule);"
        " document.adoptedStyleSheets = [s]; }",
        LARGE_TEXT,
    )


def test_stop_is_large_and_alone(page: Page, address: str, stage: Stage) -> None:
    _open(page, address, stage, "aligning")
    stop = page.get_by_role("button", name="Stop", exact=True)
    box = stop.bounding_box()
    bar = page.locator(".stop-bar").bounding_box()
    assert box is not None
    assert bar is not None
    assert box["height"] >= MIN_STOP_PX
    # The bar covers what is below it, so its padding is the air around the button.
    assert box["y"] - bar["y"] >= MIN_AIR_PX
    assert bar["y"] + bar["height"] - box["y"] - box["height"] >= MIN_AIR_PX
    middle = box["x"] + box["width"] / 2
    for y in (box["y"] - MIN_AIR_PX + 1, box["y"] + box["height"] + MIN_AIR_PX - 1):
        assert page.evaluate(
            "([x, y]) => document.elementFromPoint(x, y).closest('button, a, summary') === null",
            [middle, y],
        ), "another control is within the air of the stop button"


def test_two_taps_start_a_charge(page: Page, address: str, stage: Stage) -> None:
    _open(page, address, stage, "ready")
    page.get_by_role("button", name="Charge", exact=True).tap()
    with page.expect_request(lambda request: request.url.endswith("/jobs")) as started:
        page.get_by_role("button", name="Renault Zoe").tap()
    assert started.value.post_data_json == {"type": "charge", "vehicle_id": "zoe"}
    assert started.value.headers["idempotency-key"]


def test_page_keeps_its_budget_and_its_policy(desktop: Page, address: str, stage: Stage) -> None:
    responses: list[Response] = []
    complaints: list[str] = []
    desktop.on("response", lambda response: responses.append(response))  # noqa: PLW0108 - Playwright cannot take a built-in
    desktop.on("console", lambda message: complaints.append(message.text))
    desktop.on("pageerror", lambda error: complaints.append(str(error)))
    _open(desktop, address, stage, "charging")
    expect(desktop.get_by_role("heading", level=1)).to_have_text("Your car is charging")
    assert complaints == []
    assert all(response.url.startswith(address) for response in responses)
    assert len(responses) <= MAX_REQUESTS
    sent = sum(
        response.request.sizes()["responseBodySize"]
        + response.request.sizes()["responseHeadersSize"]
        for response in responses
    )
    assert 5_000 < sent <= MAX_BYTES


def test_changing_states_move_nothing(desktop: Page, address: str, stage: Stage) -> None:
    _open(desktop, address, stage, "locating")
    desktop.evaluate(
        "() => { window.shift = 0; new PerformanceObserver((list) => {"
        " for (const e of list.getEntries()) window.shift += e.value;"
        " }).observe({ type: 'layout-shift', buffered: true }); }"
    )
    for scene, headline in (
        ("aligning", "Moving to the car"),
        ("inserting", "Plugging in"),
        ("charging", "Your car is charging"),
    ):
        stage.live = SCENES[scene]
        expect(desktop.get_by_role("heading", level=1)).to_have_text(headline)
    assert desktop.evaluate("window.shift") < 0.1
