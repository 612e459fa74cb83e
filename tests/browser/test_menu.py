"""The dialog about people and devices, and the stop that it must not cover."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Locator, Page

from tests.browser.axe import violations
from tests.browser.chromium import DESKTOP, PHONE
from tests.browser.scenes import SCENES
from tests.browser.stage import Stage

ON_TOP = """(button) => {
  const box = button.getBoundingClientRect();
  const at = (x, y) => button.contains(document.elementFromPoint(x, y));
  return [0.05, 0.5, 0.95].every((x) => [0.1, 0.5, 0.9].every(
    (y) => at(box.left + x * box.width, box.top + y * box.height)));
}"""


@pytest.fixture(params=["phone", "desktop"])
def page(browser: Browser, request: pytest.FixtureRequest) -> Iterator[Page]:
    size = PHONE if request.param == "phone" else DESKTOP
    context = browser.new_context(
        viewport={"width": size["width"], "height": size["height"]}, reduced_motion="reduce"
    )
    yield context.new_page()
    context.close()


def _opened(page: Page, address: str) -> Locator:
    page.goto(address)
    page.locator(".link[data-link=live]").wait_for()
    page.get_by_role("button", name="People and devices").click()
    dialog = page.get_by_role("dialog")
    dialog.get_by_role("button", name="Invite somebody").wait_for()
    return dialog


@pytest.mark.parametrize(
    ("path", "stops"),
    [("/", {"stop": "Stop"}), ("/technician", {"stop": "Stop", "estop": "Emergency stop"})],
)
def test_the_stop_stays_in_reach_while_the_robot_moves(
    page: Page, stage: Stage, address: str, path: str, stops: dict[str, str]
) -> None:
    stage.live = SCENES["aligning"]
    page.goto(address + path)
    places = {
        name: page.get_by_role("button", name=name, exact=True).bounding_box()
        for name in stops.values()
    }
    dialog = _opened(page, address + path)
    for request, name in stops.items():
        stop = dialog.get_by_role("button", name=name, exact=True)
        assert stop.bounding_box() == places[name], "it stays where it was"
        assert stop.evaluate(ON_TOP), "something covers it"
        with page.expect_request(f"**/robot/{request}"):
            stop.click()
    dialog.get_by_role("button", name="Done").last.click()


@pytest.mark.parametrize("scene", ["ready", "aligning"])
def test_it_is_accessible_and_fits(page: Page, stage: Stage, address: str, scene: str) -> None:
    stage.live = SCENES[scene]
    dialog = _opened(page, address)
    for tab in ("People", "Keys", "Activity", "Me"):
        dialog.get_by_role("button", name=tab, exact=True).click()
        assert violations(page) == [], tab
        assert dialog.evaluate("d => d.scrollWidth <= d.clientWidth"), tab
        done = dialog.get_by_role("button", name="Done").last
        done.scroll_into_view_if_needed()
        assert done.evaluate(ON_TOP), "the stop covers the way out"
