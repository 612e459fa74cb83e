"""The robot's own touch screen: everything in sight, no keyboard, and a stop for everybody."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.axe import violations
from tests.browser.control_scenes import SCENES as CONTROL
from tests.browser.languages import LOCALES, overflows
from tests.browser.scenes import SCENES
from tests.browser.stage import ON_THE_ROBOT, OWNER, STRANGER, Stage
from tests.support.process import ServerProcess, serving

SIZES = {"7 inches": (800, 480), "10 inches": (1024, 600)}
REST_MS = 60_000
"""web/src/kiosk/resting.ts"""
STATES = (
    "ready",
    "charging_priced",
    "aligning",
    "needs_person",
    "parted",
    "fault",
    "unknown",
    "control-held",
    "control-asking",
)
MIN_TARGET_PX = 44
MIN_STOP_PX = 96


@pytest.fixture(scope="module", params=SIZES)
def size(request: pytest.FixtureRequest) -> tuple[int, int]:
    """One screen after the other."""
    return SIZES[request.param]


def _page(browser: Browser, size: tuple[int, int], language: str = "en") -> Iterator[Page]:
    context = browser.new_context(
        viewport={"width": size[0], "height": size[1]},
        has_touch=True,
        locale=LOCALES[language],
        color_scheme="dark" if language in {"de", "it"} else "light",
        reduced_motion="reduce",
    )
    page = context.new_page()
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    yield page
    context.close()
    assert errors == []


@pytest.fixture
def page(browser: Browser, size: tuple[int, int]) -> Iterator[Page]:
    """A touch screen."""
    yield from _page(browser, size)


@pytest.fixture
def small(browser: Browser) -> Iterator[Page]:
    """The smaller of them."""
    yield from _page(browser, SIZES["7 inches"])


@pytest.fixture(autouse=True)
def _signed_in(stage: Stage) -> None:
    stage.session = OWNER


def _open(page: Page, address: str) -> None:
    page.goto(f"{address}/kiosk")
    page.locator(".link[data-link=live]").wait_for()


@pytest.mark.parametrize("language", LOCALES)
def test_everything_is_in_sight_without_scrolling(
    browser: Browser, size: tuple[int, int], address: str, stage: Stage, language: str
) -> None:
    troubles: dict[str, list[str]] = {}
    for page in _page(browser, size, language):
        for name in STATES:
            stage.live = {**SCENES, **CONTROL}[name]
            _open(page, address)
            troubles[name] = overflows(page)
            for target in page.locator("button").all():
                box = target.bounding_box()
                assert box is not None
                assert box["y"] + box["height"] <= size[1], (name, target.inner_text())
                assert min(box["width"], box["height"]) >= MIN_TARGET_PX, target.inner_text()
            text = page.locator(".hero-text").bounding_box()
            assert text is not None
            assert text["y"] + text["height"] <= size[1], name
        troubles["axe"] = violations(page)
    assert {name: found for name, found in troubles.items() if found} == {}


def test_the_stop_is_huge_and_covers_nothing(page: Page, address: str, stage: Stage) -> None:
    stage.live = SCENES["aligning"]
    _open(page, address)
    stop = page.get_by_role("button", name="Stop", exact=True).bounding_box()
    cancel = page.get_by_role("button", name="Cancel").bounding_box()
    pause = page.get_by_role("button", name="Pause").bounding_box()
    assert stop is not None
    assert cancel is not None
    assert pause is not None
    assert stop["height"] >= MIN_STOP_PX
    lowest = max(cancel["y"] + cancel["height"], pause["y"] + pause["height"])
    assert stop["y"] - lowest >= 24


def test_nothing_asks_for_a_keyboard(small: Page, address: str, stage: Stage) -> None:
    stage.live = SCENES["ready"]
    _open(small, address)
    assert small.get_by_role("button", name="Plan a charge").count() == 0
    small.get_by_role("button", name="Charge", exact=True).tap()
    small.get_by_role("dialog").wait_for()
    assert small.locator("input, textarea").count() == 0
    assert violations(small) == []


def test_it_rests_and_the_touch_that_wakes_presses_nothing(
    small: Page, address: str, stage: Stage
) -> None:
    stage.live = SCENES["ready"]
    small.clock.install()
    _open(small, address)
    small.clock.fast_forward(REST_MS + 1000)
    rest = small.locator(".rest")
    expect(rest).to_contain_text("Ready to charge")
    assert violations(small) == []
    # Where Charge was.
    charge = small.locator(".hero-action .primary").bounding_box()
    assert charge is not None
    stage.requests.clear()
    small.touchscreen.tap(charge["x"] + 30, charge["y"] + 30)
    expect(rest).to_have_count(0)
    assert small.get_by_role("dialog").count() == 0
    assert stage.requests == []


@pytest.mark.parametrize("scene", ["aligning", "unknown"])
def test_a_motion_and_a_question_wake_it(
    small: Page, address: str, stage: Stage, scene: str
) -> None:
    stage.live = SCENES["ready"]
    small.clock.install()
    _open(small, address)
    small.clock.fast_forward(REST_MS + 1000)
    small.locator(".rest").wait_for()
    stage.live = SCENES[scene]
    small.clock.resume()
    expect(small.locator(".rest")).to_have_count(0)
    small.clock.fast_forward(2 * REST_MS)
    assert small.locator(".rest").count() == 0


def test_elsewhere_a_stranger_meets_the_door(small: Page, address: str, stage: Stage) -> None:
    stage.session = STRANGER
    small.goto(f"{address}/kiosk")
    expect(small.get_by_role("heading", level=1)).to_have_text("This device is not paired yet")
    assert small.get_by_role("button", name="Stop").count() == 0


def test_a_stop_that_is_not_confirmed_says_so(small: Page, address: str, stage: Stage) -> None:
    stage.session = ON_THE_ROBOT
    small.goto(f"{address}/kiosk")
    small.route("**/robot/stop", lambda route: route.abort())
    small.get_by_role("button", name="Stop the robot").tap()
    expect(small.get_by_role("alert")).to_contain_text("not confirmed")
    assert violations(small) == []


@pytest.fixture(scope="module")
def server() -> Iterator[ServerProcess]:
    """The real server, on this very machine."""
    with serving("--seed", "3") as running:
        yield running


def test_on_the_machine_itself_nobody_signs_in_for_a_stop(
    small: Page, server: ServerProcess
) -> None:
    small.goto(f"{server.url}/kiosk")
    small.get_by_role("button", name="Stop the robot").tap()
    expect(small.get_by_role("status")).to_be_visible()
    with server.rest() as client:
        assert client.get("robot").json()["mode"] == "stopped"
