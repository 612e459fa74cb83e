"""What the home page tells beside the state of the robot: nothing can be saved, what comes next."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.chromium import PHONE
from tests.browser.scenes import SCENES
from tests.browser.stage import Stage

WAITING = "/jobs/01956b1e-8c00-7000-8000-000000000002"


@pytest.fixture
def page(browser: Browser, address: str, stage: Stage) -> Iterator[Page]:
    """The page of a phone whose robot charges and has nothing else to say."""
    context = browser.new_context(
        viewport={"width": PHONE["width"], "height": PHONE["height"]},
        locale="en-GB",
        timezone_id="UTC",
    )
    page = context.new_page()
    stage.live = SCENES["charging"]
    stage.requests.clear()
    page.goto(address)
    page.locator(".link[data-link=live]").wait_for()
    yield page
    context.close()


def test_a_full_disk_is_told_in_words_and_goes_away(page: Page, stage: Stage) -> None:
    notices = page.get_by_role("status").filter(has_text="Nothing can be saved")
    expect(notices).to_have_count(0)
    stage.live = SCENES["disk_full"]
    expect(notices).to_contain_text("You can still stop the robot and unplug the car.")
    expect(notices).to_contain_text("The disk is full. Make room on the disk")
    expect(notices).not_to_contain_text("sqlite")
    stage.live = SCENES["charging"]
    expect(notices).to_have_count(0)


def test_the_job_that_waits_is_shown_and_can_be_cancelled(page: Page, stage: Stage) -> None:
    stage.live = SCENES["next"]
    expect(page.get_by_text("A charge begins on 1 Mar, 22:04.")).to_be_visible()
    expect(page.get_by_text("The car is unplugged by 2 Mar, 07:04.")).to_be_visible()
    expect(page.get_by_role("heading", level=1)).to_have_text("Your car is charging")
    page.get_by_role("button", name="Cancel it").click()
    expect(page.get_by_role("button", name="Cancel it")).to_be_enabled()
    assert stage.requests == [f"POST {WAITING}/cancel"]
    stage.live = SCENES["charging"]
    expect(page.get_by_role("button", name="Cancel it")).to_have_count(0)


def test_a_paused_job_that_waits_can_go_on(page: Page, stage: Stage) -> None:
    stage.live = SCENES["disk_full"]
    expect(page.get_by_text("Unplugging is paused and does not begin by itself.")).to_be_visible()
    page.get_by_role("button", name="Go on").click()
    expect(page.get_by_role("button", name="Go on")).to_be_enabled()
    assert stage.requests == [f"POST {WAITING}/resume"]


def test_a_job_that_waits_alone_is_told_once(page: Page, stage: Stage) -> None:
    planned = SCENES["planned"]
    assert planned.job is not None
    queue = planned.queue.model_copy(update={"waiting": planned.job})
    stage.live = planned.model_copy(update={"queue": queue})
    expect(page.get_by_role("heading", level=1)).to_have_text("The charge is planned")
    expect(page.get_by_role("button", name="Cancel it")).to_have_count(0)
