"""A bad network: the page never shows the past as the present, and a stop goes out or says so."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.chromium import phone_page
from tests.browser.scenes import SCENES
from tests.browser.stage import Stage, serve
from tests.support.lossy_proxy import LossyProxy

SAID_WITHIN_MS = 4_000
"""Stale is said after 1 s of silence; the rest is the patience with a busy machine."""
BACK_WITHIN_MS = 20_000


@pytest.fixture
def stage(stage: Stage) -> Stage:
    """Of its own for each test; skips where nothing is built."""
    del stage
    fresh = Stage()
    fresh.live = SCENES["aligning"]
    return fresh


@pytest.fixture
def network(stage: Stage) -> Iterator[LossyProxy]:
    """The way to the stage."""
    with serve(stage) as url, LossyProxy(int(url.rsplit(":", 1)[1])).running() as proxy:
        yield proxy


@pytest.fixture
def phone(browser: Browser, network: LossyProxy) -> Iterator[Page]:
    """A phone that has opened the page while all was well."""
    with phone_page(browser, locale="en-GB") as page:
        page.goto(network.url)
        page.locator(".link[data-link=live]").wait_for()
        yield page


def _is_stale(phone: Page) -> None:
    expect(phone.locator(".link")).not_to_have_attribute(
        "data-link", "live", timeout=SAID_WITHIN_MS
    )
    expect(phone.locator(".hero-action .button.big")).to_be_disabled()


def _is_live(phone: Page) -> None:
    expect(phone.locator(".link")).to_have_attribute("data-link", "live", timeout=BACK_WITHIN_MS)


def _stopped(phone: Page, stage: Stage) -> None:
    for _ in range(100):
        if stage.stops:
            return
        phone.wait_for_timeout(100)
    pytest.fail("no stop has come")


def test_a_stall_is_said_and_what_was_missed_is_caught_up(
    phone: Page, network: LossyProxy, stage: Stage
) -> None:
    network.stall()
    stage.live = SCENES["charging"]
    _is_stale(phone)
    expect(phone.locator(".hero-text")).not_to_contain_text("charging")
    network.flow()
    _is_live(phone)
    expect(phone.get_by_role("heading", level=1)).to_have_text("Your car is charging")


def test_messages_that_come_too_late_are_not_taken_for_news(
    phone: Page, network: LossyProxy
) -> None:
    """The line never falls silent for long: its messages are three seconds old."""
    network.delay_s = 3.0
    _is_stale(phone)
    phone.wait_for_timeout(6_000)
    expect(phone.locator(".link")).not_to_have_attribute("data-link", "live")
    network.delay_s = 0.0
    _is_live(phone)


def test_a_line_that_is_cut_again_and_again_comes_back(phone: Page, network: LossyProxy) -> None:
    for _ in range(5):
        network.cut()
        phone.wait_for_timeout(300)
    _is_live(phone)


def test_a_stop_in_a_stall_says_that_it_is_not_sure_and_goes_out_later(
    phone: Page, network: LossyProxy, stage: Stage
) -> None:
    network.stall()
    phone.get_by_role("button", name="Stop", exact=True).click()
    alarm = phone.get_by_role("alert")
    expect(alarm).to_contain_text("The stop was not confirmed", timeout=10_000)
    expect(alarm).to_contain_text("emergency stop on the robot")
    assert stage.stops == 0, "nothing went through"
    network.flow()
    _stopped(phone, stage)
    _is_live(phone)


def test_a_stop_finds_its_way_past_a_cut(phone: Page, network: LossyProxy, stage: Stage) -> None:
    network.cut()
    phone.get_by_role("button", name="Stop", exact=True).click()
    _stopped(phone, stage)
