"""A newcomer's first charge: the real server, the real page, two taps."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.chromium import PHONE
from tests.support.process import ServerProcess, serving

SPEED = "10"
JOB_TIMEOUT_MS = 60_000


@pytest.fixture(scope="module")
def server() -> Iterator[ServerProcess]:
    """The real server on the simulator, ten times as fast as a real robot."""
    with serving("--speed", SPEED, "--seed", "3") as running:
        yield running


@pytest.fixture
def phone(browser: Browser, server: ServerProcess) -> Iterator[Page]:
    """A phone that has opened the home page; it may not meet a single script error."""
    context = browser.new_context(
        viewport={"width": PHONE["width"], "height": PHONE["height"]}, has_touch=True
    )
    server.let_in(context)
    page = context.new_page()
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(server.url)
    yield page
    context.close()
    assert errors == []


def test_two_taps_plug_the_car_in_and_one_unplugs_it(phone: Page, server: ServerProcess) -> None:
    expect(phone.get_by_role("heading", level=1)).to_have_text("Ready when you are")

    phone.get_by_role("button", name="Charge", exact=True).tap()

    stop_and_unplug = phone.get_by_role("button", name="Stop and unplug")
    stop_and_unplug.wait_for(timeout=JOB_TIMEOUT_MS)
    expect(phone.get_by_role("heading", level=1)).to_have_text("Your car is charging")
    with server.rest() as client:
        (job,) = client.get("jobs").json()["items"]
        assert job["phase"] == "charging"
        assert abs(job["result"]["insertion_depth_mm"] - 40) <= 1
        assert client.get("robot").json()["plug"] == "inserted"

        stop_and_unplug.tap()

        phone.get_by_role("button", name="Charge", exact=True).wait_for(timeout=JOB_TIMEOUT_MS)
        (job,) = client.get("jobs").json()["items"]
        assert job["state"] == "succeeded"
        assert client.get("robot").json()["plug"] == "parked"


def test_stop_halts_the_robot_and_releasing_it_asks_first(
    phone: Page, server: ServerProcess
) -> None:
    phone.get_by_role("button", name="Charge", exact=True).tap()
    stop = phone.get_by_role("button", name="Stop", exact=True)
    stop.wait_for(timeout=JOB_TIMEOUT_MS)

    stop.tap()

    with server.rest() as client:
        release = phone.get_by_role("button", name="Release the stop")
        release.wait_for(timeout=JOB_TIMEOUT_MS)
        assert client.get("robot").json()["mode"] == "stopped"
        (job, _) = client.get("jobs").json()["items"]
        assert (job["state"], job["error"]["code"]) == ("failed", "stopped")

        release.tap()
        assert client.get("robot").json()["mode"] == "stopped", "a dialog must ask first"
        phone.get_by_role("dialog").get_by_role("button", name="Yes, release").tap()

        phone.get_by_role("button", name="Try again").wait_for(timeout=JOB_TIMEOUT_MS)
        assert client.get("robot").json()["mode"] == "ready"


def test_a_job_that_is_not_possible_is_explained(phone: Page, server: ServerProcess) -> None:
    with server.rest() as client:
        client.delete("vehicles/demo").raise_for_status()

    phone.get_by_role("button", name="Try again").tap()

    expect(phone.get_by_text("No car is known yet")).to_be_visible()
    with server.rest() as client:
        assert client.get("robot").json()["mode"] == "ready"


def test_control_changes_hands_when_its_holder_says_so(
    browser: Browser, phone: Page, server: ServerProcess
) -> None:
    with server.rest() as owner:
        owner.post("robot/control/request").raise_for_status()
        invited = owner.post("access/invitations", json={"name": "Tim", "role": "technician"})
        tim = browser.new_page()
        tim.goto(invited.json()["address"])
        tim.locator(".link[data-link=live]").wait_for()
        tim.goto(f"{server.url}/technician")
        ask = tim.get_by_role("button", name="Ask for control")
        ask.click()
        question = phone.get_by_role("alert").filter(has_text="Tim (technician) asks for control")
        question.get_by_role("button", name="Keep control").tap()
        expect(tim.locator(".control-notice")).to_contain_text("keeps control")

        tim.get_by_role("button", name="Got it").click()
        ask.click()
        question.get_by_role("button", name="Give control").tap()
        expect(tim.locator(".control-notice")).to_contain_text("has given you control")
        expect(phone.locator(".control-notice")).to_contain_text("Tim (technician) is in control")
        expect(phone.get_by_role("button", name="Try again")).to_be_disabled()
        assert owner.get("robot/control").json()["holder"]["person"]["name"] == "Tim"
        assert owner.post("robot/enable").json()["code"] == "control_held"
    tim.close()


def test_a_lost_server_is_said_without_pushing_the_page_aside(browser: Browser) -> None:
    with serving("--speed", SPEED) as server:
        context = browser.new_context(viewport={"width": PHONE["width"], "height": PHONE["height"]})
        server.let_in(context)
        page = context.new_page()
        page.goto(server.url)
        expect(page.get_by_role("heading", level=1)).to_have_text("Ready when you are")

        server.kill()

        expect(page.get_by_role("heading", level=1)).to_have_text("Cannot reach the robot")
        width_px = page.evaluate("document.documentElement.scrollWidth")
        assert width_px <= PHONE["width"]
        context.close()
