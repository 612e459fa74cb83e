"""Connections that break, sleep or crawl: the page comes back, and nothing typed is lost."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.chromium import phone_page
from tests.browser.scenes import SCENES
from tests.browser.stage import Stage, serve

SLOW = {
    "offline": False,
    "latency": 600,
    "downloadThroughput": 20_000,
    "uploadThroughput": 10_000,
}
"""A bad mobile network: 160 kbit/s, and more than half a second for each journey."""


@pytest.fixture
def phone(browser: Browser) -> Iterator[Page]:
    """A phone."""
    with phone_page(browser, locale="en-GB") as page:
        yield page


def test_a_restart_of_the_server_takes_nothing_that_was_typed(phone: Page, stage: Stage) -> None:
    del stage  # skips where nothing is built
    before = Stage()
    with serve(before) as url:
        phone.goto(url)
        phone.get_by_role("button", name="Plan a charge").click()
        dialog = phone.get_by_role("dialog")
        dialog.get_by_label("Only").check()
        dialog.get_by_label("Energy, kWh").fill("17.5")
    expect(phone.locator(".link")).to_have_attribute("data-link", "lost")
    after = Stage()
    with serve(after, int(url.rsplit(":", 1)[1])):
        expect(phone.locator(".link")).to_have_attribute("data-link", "live")
        assert dialog.get_by_label("Energy, kWh").input_value() == "17.5"
        with phone.expect_request(lambda request: request.url.endswith("/jobs")) as planned:
            dialog.get_by_role("button", name="Plan it").click()
        job = planned.value.post_data_json
        assert job is not None
        assert job["target_energy_wh"] == 17_500


def test_a_frozen_page_wakes_up_to_what_is_true_now(
    phone: Page, address: str, stage: Stage
) -> None:
    stage.live = SCENES["charging"]
    phone.goto(address)
    heading = phone.get_by_role("heading", level=1)
    expect(heading).to_have_text("Your car is charging")
    session = phone.context.new_cdp_session(phone)
    session.send("Page.setWebLifecycleState", {"state": "frozen"})
    stage.live = SCENES["done"]
    session.send("Page.setWebLifecycleState", {"state": "active"})
    expect(heading).to_have_text("Charging is done")


def test_a_crawling_connection_opens_the_page_and_carries_a_stop(
    phone: Page, address: str, stage: Stage
) -> None:
    stage.live = SCENES["aligning"]
    stage.requests.clear()
    session = phone.context.new_cdp_session(phone)
    session.send("Network.enable")
    session.send("Network.emulateNetworkConditions", SLOW)
    phone.goto(address, timeout=60_000)
    stop = phone.get_by_role("button", name="Stop", exact=True)
    stop.wait_for(timeout=30_000)
    # The stage confirms no stop over the WebSocket, so the page has to try the second way.
    with phone.expect_request(lambda request: request.url.endswith("/robot/stop"), timeout=5_000):
        stop.click()


def test_two_people_see_who_moves_the_robot(
    browser: Browser, phone: Page, address: str, stage: Stage
) -> None:
    stage.live = SCENES["jog"]
    other = browser.new_page(locale="de-DE")
    for page, sentence in ((phone, "In control: Anna."), (other, "Gesteuert von: Anna.")):
        page.goto(address)
        expect(page.locator(".hero-text")).to_contain_text(sentence)
        page.locator(".robot summary").click()
        expect(page.locator(".robot dl")).to_contain_text("Anna")
    stage.live = SCENES["ready"]
    for page in (phone, other):
        expect(page.locator("main")).not_to_contain_text("Anna")
    other.close()
