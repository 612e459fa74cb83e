"""The installed page: opens without its robot, says so, and becomes the new one after an update."""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect
from playwright.sync_api import Error as PlaywrightError

from tests.browser.axe import violations
from tests.browser.chromium import phone_page
from tests.browser.scenes import SCENES
from tests.browser.stage import STATIC_DIR, Stage, serve

INSTALLED = "navigator.serviceWorker.ready.then(() => true)"
CONTROLLED = "navigator.serviceWorker.controller !== null"
WAITING = (
    "navigator.serviceWorker.getRegistration()"
    ".then((r) => r.update().then(() => r.waiting !== null))"
)
LOOK_MS = 2_000
"""The page looks so often whether it may be replaced: web/src/installed/freshness.ts."""


@pytest.fixture
def phone(browser: Browser) -> Iterator[Page]:
    """A phone that has never seen the page."""
    with phone_page(browser, locale="de-DE") as page:
        yield page


@pytest.fixture
def build(stage: Stage, tmp_path: Path) -> Path:
    """A build of its own, to be replaced by another one."""
    del stage  # skips where nothing is built
    return Path(shutil.copytree(STATIC_DIR, tmp_path / "static"))


def _replace(build: Path) -> None:
    """The next version, as another build would leave it."""
    for packed in (build / "index.html.gz", build / "worker.js.gz"):
        packed.unlink()
    page = build / "index.html"
    text = page.read_text(encoding="utf-8")
    page.write_text(text.replace("<head>", '<head><meta name="build" content="next">'), "utf-8")
    worker = build / "worker.js"
    code, changed = re.subn(r'"version":"\w+"', '"version":"next"', worker.read_text("utf-8"))
    assert changed == 1
    worker.write_text(code, encoding="utf-8")


def _live(page: Page) -> None:
    page.locator(".link[data-link=live]").wait_for(timeout=15_000)


def _become(page: Page, condition: str) -> None:
    """Wait from outside: the policy of the page lets nothing wait inside."""
    for _ in range(100):
        with suppress(PlaywrightError):  # the page is being loaded anew
            if page.evaluate(condition):
                return
        page.wait_for_timeout(200)
    pytest.fail(f"never: {condition}")


def test_opens_without_the_robot_and_says_so(phone: Page) -> None:
    stage = Stage()
    stage.live = SCENES["charging"]
    with serve(stage) as url:
        phone.goto(url)
        _live(phone)
        assert phone.evaluate(INSTALLED)
        expect(phone.get_by_role("heading", level=1)).to_have_text("Ihr Auto lädt")
    # The robot is gone, and the page is opened anew.
    phone.goto(url)
    heading = phone.get_by_role("heading", level=1)
    expect(heading).to_have_text("Roboter nicht erreichbar")
    expect(phone.locator("body")).not_to_contain_text("lädt")
    assert phone.get_by_role("button").count() == 0, "nothing can be pressed without a robot"
    assert violations(phone) == []
    # It comes back: nobody has to do anything.
    stage = Stage()
    stage.live = SCENES["ready"]
    with serve(stage, int(url.rsplit(":", 1)[1])):
        _live(phone)
        expect(heading).to_have_text("Bereit zum Laden")


def test_nothing_of_the_robot_is_kept(phone: Page) -> None:
    with serve(Stage()) as url:
        phone.goto(url)
        _live(phone)
        assert phone.evaluate(INSTALLED)
        phone.locator(".history summary").click()
        phone.locator(".past").wait_for()
        kept = phone.evaluate(
            "async () => { const all = [];"
            " for (const name of await caches.keys())"
            "   for (const each of await (await caches.open(name)).keys())"
            "     all.push(new URL(each.url).pathname);"
            " return all; }"
        )
    assert "/" in kept
    assert {path for path in kept if not re.match(r"/(assets/|icons/|manifest|$)", path)} == set()


def test_an_update_waits_for_whoever_is_typing(phone: Page, build: Path) -> None:
    with serve(Stage(build)) as url:
        phone.goto(url)
        _live(phone)
        assert phone.evaluate(INSTALLED)
        _become(phone, CONTROLLED)
        phone.get_by_role("button", name="Laden planen").click()
        dialog = phone.get_by_role("dialog")
        dialog.get_by_label("Nur").check()
        energy = dialog.get_by_label("Energie, kWh")
        energy.fill("17.5")
        _replace(build)
        _become(phone, WAITING)
        phone.wait_for_timeout(2 * LOOK_MS)
        assert energy.input_value() == "17.5"
        assert phone.locator("meta[name=build]").count() == 0
        phone.keyboard.press("Escape")
        phone.wait_for_selector("meta[name=build]", state="attached", timeout=10 * LOOK_MS)
        _live(phone)
        expect(phone.get_by_role("heading", level=1)).to_have_text("Bereit zum Laden")
        names = phone.evaluate("caches.keys()")
    assert names == ["home-next"]


def test_new_software_of_the_robot_brings_its_page(phone: Page) -> None:
    stage = Stage()
    with serve(stage) as url:
        phone.goto(url)
        _live(phone)
        phone.evaluate("window.old = true")
        service = stage.live.service.model_copy(update={"version": "0.2.0"})
        stage.live = stage.live.model_copy(update={"service": service})
        _become(phone, "window.old === undefined")
        _live(phone)


def test_can_be_installed(phone: Page, address: str, stage: Stage) -> None:
    stage.live = SCENES["ready"]
    phone.goto(address)
    link = phone.locator("link[rel=manifest]").get_attribute("href")
    manifest = json.loads(phone.request.get(f"{address}{link}").text())
    assert manifest["display"] == "standalone"
    assert manifest["start_url"] == manifest["scope"] == "/"
    for icon in manifest["icons"]:
        answer = phone.request.get(address + icon["src"])
        assert answer.headers["content-type"] == icon["type"]
    assert {icon["sizes"] for icon in manifest["icons"]} >= {"192x192", "512x512"}
    session = phone.context.new_cdp_session(phone)
    errors = session.send("Page.getInstallabilityErrors")["installabilityErrors"]
    assert [each["errorId"] for each in errors if each["errorId"] != "in-incognito"] == []
