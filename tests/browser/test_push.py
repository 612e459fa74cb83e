"""Notifications: asked for after a press only, told to the robot, shown by the service worker."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.axe import violations
from tests.browser.chromium import phone_page
from tests.browser.scenes import SCENES
from tests.browser.stage import PUSH_KEY, Stage, serve

SUBSCRIBED = """
window.asked = 0;
const ask = Notification.requestPermission.bind(Notification);
Notification.requestPermission = () => { window.asked += 1; return ask(); };
let made = null;
PushManager.prototype.getSubscription = async () => made;
PushManager.prototype.subscribe = async (options) => {
  window.wanted = options;
  made = {
    toJSON: () => ({ endpoint: "https://push.example.net/1", keys: { p256dh: "BA", auth: "BT" } }),
    unsubscribe: async () => { made = null; return true; },
  };
  return made;
};
"""
"""A browser with a push service: the machine of a test reaches none."""


@pytest.fixture
def stage() -> Stage:
    """Of its own for each test."""
    stage = Stage()
    stage.live = SCENES["ready"]
    return stage


@pytest.fixture
def address(stage: Stage) -> Iterator[str]:
    """Where it is served."""
    with serve(stage) as url:
        yield url


@pytest.fixture
def phone(browser: Browser, address: str) -> Iterator[Page]:
    """A German phone that may notify."""
    with phone_page(browser, locale="de-DE") as page:
        page.context.grant_permissions(["notifications"], origin=address)
        yield page


def _open_own(page: Page, address: str) -> None:
    page.goto(address)
    page.locator(".link[data-link=live]").wait_for()
    page.locator(".menu-button").click()
    page.locator(".tabs .button").last.click()
    page.locator(".notify").wait_for()


def test_it_is_asked_for_after_a_press_and_ends_with_another(
    phone: Page, address: str, stage: Stage
) -> None:
    phone.add_init_script(SUBSCRIBED)
    _open_own(phone, address)
    begin = phone.get_by_role("button", name="Auf diesem Gerät benachrichtigen")
    begin.wait_for()
    assert phone.evaluate("window.asked") == 0
    begin.click()
    end = phone.get_by_role("button", name="Nicht mehr benachrichtigen")
    end.wait_for()
    assert phone.evaluate("window.wanted") == {
        "userVisibleOnly": True,
        "applicationServerKey": PUSH_KEY,
    }
    assert stage.subscription is not None
    assert stage.subscription.endpoint == "https://push.example.net/1"
    assert stage.subscription.language == "de"
    assert violations(phone) == []
    end.click()
    begin.wait_for()
    assert stage.subscription is None


def test_where_it_cannot_be_the_page_says_so(phone: Page, address: str) -> None:
    phone.add_init_script("delete window.PushManager")
    _open_own(phone, address)
    expect(phone.locator(".notify")).to_contain_text("https")
    assert phone.locator(".notify button").count() == 0


def test_the_service_worker_shows_what_comes(phone: Page, address: str) -> None:
    session = phone.context.new_cdp_session(phone)
    registered: list[dict[str, Any]] = []
    session.on(
        "ServiceWorker.workerRegistrationUpdated",
        lambda event: registered.extend(event["registrations"]),
    )
    session.send("ServiceWorker.enable")
    phone.goto(address)
    assert phone.evaluate("navigator.serviceWorker.ready.then((r) => r.active !== null)")
    message = {"kind": "needs_person", "language": "fr", "detail": "", "energy_wh": None}
    session.send(
        "ServiceWorker.deliverPushMessage",
        {
            "origin": address,
            "registrationId": registered[-1]["registrationId"],
            "data": json.dumps(message),
        },
    )
    shown = (
        "navigator.serviceWorker.ready.then((r) => r.getNotifications())"
        ".then((all) => all.map((n) => [n.title, n.lang, n.tag]))"
    )
    phone.wait_for_function(f"{shown}.then((all) => all.length > 0)")
    assert phone.evaluate(shown) == [["Le robot a besoin de vous", "fr", "plugpilot"]]


def test_a_tab_that_nobody_looks_at_says_that_the_robot_asks(
    phone: Page, address: str, stage: Stage
) -> None:
    phone.goto(address)
    expect(phone).to_have_title("PlugPilot")
    stage.live = SCENES["needs_person"]
    expect(phone).to_have_title("● Der Roboter braucht Sie · PlugPilot")
