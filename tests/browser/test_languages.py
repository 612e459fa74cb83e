"""Four languages on the narrowest phone: nothing runs over, and nothing stays in English."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from server.schema.live import Live
from tests.browser.axe import violations
from tests.browser.guidance_scenes import SCENES as GUIDANCE
from tests.browser.languages import LOCALES, overflows
from tests.browser.scenes import SCENES
from tests.browser.stage import Stage

NARROW = {"width": 320, "height": 640}
MAX_REQUESTS = 10
MAX_BYTES = 60_000

READY = {
    "en": "Ready to charge",
    "fr": "Prêt à charger",
    "de": "Bereit zum Laden",
    "it": "Pronto a ricaricare",
}
PLAN = {
    "en": "Plan a charge",
    "fr": "Programmer une charge",
    "de": "Laden planen",
    "it": "Programma una ricarica",
}


def _narrow(browser: Browser, language: str) -> Iterator[Page]:
    context = browser.new_context(
        viewport={"width": NARROW["width"], "height": NARROW["height"]},
        locale=LOCALES[language],
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


@pytest.fixture(scope="module", params=LOCALES)
def language(request: pytest.FixtureRequest) -> str:
    """One after the other."""
    name: str = request.param
    return name


@pytest.fixture(scope="module")
def page(browser: Browser, language: str) -> Iterator[Page]:
    """A narrow phone whose browser asks for the language."""
    yield from _narrow(browser, language)


@pytest.fixture
def home(page: Page, address: str, stage: Stage, language: str) -> Page:
    """The home page, at rest."""
    stage.live = SCENES["ready"]
    page.goto(address)
    expect(page.get_by_role("heading", level=1)).to_have_text(READY[language])
    return page


def _named(live: Live, name: str) -> Live:
    """With a sign by which the page shows that it has arrived."""
    return live.model_copy(update={"robot": live.robot.model_copy(update={"driver": name})})


def test_no_state_runs_over(home: Page, stage: Stage) -> None:
    home.locator(".robot summary").click()
    troubles: dict[str, list[str]] = {}
    scenes = {f"state {name}": live for name, live in SCENES.items()}
    arriving = SCENES["ready"]
    for name, guidance in GUIDANCE.items():
        scenes[f"guidance {name}"] = arriving.model_copy(update={"guidance": guidance})
    for name, live in scenes.items():
        stage.live = _named(live, name)
        expect(home.locator(".robot dl")).to_contain_text(name)
        troubles[name] = overflows(home)
    assert {name: found for name, found in troubles.items() if found} == {}


def test_no_dialog_runs_over(home: Page, language: str) -> None:
    home.locator(".history summary").click()
    home.locator(".past .button").first.wait_for()
    assert overflows(home) == []
    home.get_by_role("button", name=PLAN[language], exact=True).click()
    home.get_by_role("dialog").wait_for()
    assert overflows(home) == []
    assert violations(home) == []
    home.keyboard.press("Escape")
    home.locator(".past button").first.click()
    home.get_by_role("slider").wait_for()
    assert overflows(home) == []


def test_page_says_which_language_it_speaks(home: Page, language: str) -> None:
    assert home.evaluate("document.documentElement.lang") == language
    assert home.get_by_role("combobox").input_value() == language


def test_language_keeps_the_budget(
    browser: Browser, address: str, stage: Stage, language: str
) -> None:
    stage.live = SCENES["ready"]
    for page in _narrow(browser, language):
        page.goto(address)
        expect(page.get_by_role("heading", level=1)).to_have_text(READY[language])
        page.wait_for_load_state("networkidle")
        responses = page.evaluate(
            "() => [...performance.getEntriesByType('resource'),"
            " ...performance.getEntriesByType('navigation')]"
            ".map((each) => [each.name, each.transferSize])"
        )
    assert len(responses) + 1 <= MAX_REQUESTS, responses  # and the WebSocket
    assert 5_000 < sum(size for _, size in responses) <= MAX_BYTES


def test_somebodys_choice_is_kept(browser: Browser, address: str, stage: Stage) -> None:
    stage.live = SCENES["ready"]
    for page in _narrow(browser, "it"):
        page.goto(address)
        heading = page.get_by_role("heading", level=1)
        expect(heading).to_have_text(READY["it"])
        page.get_by_role("combobox").select_option("fr")
        expect(heading).to_have_text(READY["fr"])
        page.reload()
        expect(heading).to_have_text(READY["fr"])
