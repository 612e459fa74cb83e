"""A driver parks by what a phone shows: the real server, the real page, a simulated car."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest
from playwright.sync_api import Browser, Page, expect
from playwright.sync_api import TimeoutError as NotYetError

from server.config.settings import Settings
from server.jobs.approach import parking_joints
from tests.browser.axe import violations_by_day_and_night
from tests.browser.chromium import PHONE, phone_page
from tests.browser.guidance_scenes import SCENES
from tests.browser.scenes import SCENES as LIVE
from tests.browser.stage import Stage
from tests.support.process import ServerProcess, serving

MIN_TARGET_PX = 44
PATIENCE_MS = 90_000
CARD = ".guidance"
FAR_TO_GO = """() => {
    const [number, unit] = ["strong", ".order-unit"].map(
        (part) => document.querySelector(`.guidance .order-number ${part}`)?.textContent);
    return parseFloat(number) * (unit === "m" ? 100 : 1) > 20;
}"""


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServerProcess]:
    """The real server on the simulator; its robot is homed and parked, its car out of sight."""
    settings = Settings()
    joints = parking_joints(settings.geometry, settings.park)
    config = tmp_path_factory.mktemp("guidance") / "plugpilot.toml"
    config.write_text(
        "[simulation.parameters.board]\n"
        "start_homed = true\n"
        f"start_joints = [{joints.rho1_mm}, {joints.rho2_mm}, {joints.rho3_mm}]\n"
    )
    with serving("--config", str(config), "--seed", "2") as running:
        yield running


@pytest.fixture
def phone(browser: Browser) -> Iterator[Page]:
    """A phone that may not meet a single script error."""
    with phone_page(browser, has_touch=True, is_mobile=True, reduced_motion="reduce") as page:
        yield page


def _picture(page: Page, name: str) -> None:
    """Keep a picture for people, where somebody asks for one."""
    folder = os.environ.get("PLUGPILOT_TEST_PICTURES")
    if folder:
        page.screenshot(path=Path(folder) / f"guidance-{name}.png")


def _tell(client: httpx.Client, **order: object) -> dict[str, Any]:
    answer = client.post("simulation/car", json=order)
    answer.raise_for_status()
    now: dict[str, Any] = answer.json()
    return now


def test_a_driver_parks_by_the_phone(phone: Page, server: ServerProcess) -> None:
    server.let_in(phone.context)
    with server.rest() as client:
        phone.goto(server.url)
        phone.locator(".link[data-link=live]").wait_for(timeout=PATIENCE_MS)
        _tell(client, type="leave")  # the car that stands there from the start has a place too
        expect(phone.locator(f"{CARD} .order-number")).to_have_count(0, timeout=PATIENCE_MS)
        expect(phone.locator(f"{CARD} .car-above")).to_have_count(0, timeout=PATIENCE_MS)
        _tell(client, type="drive_in", from_mm=3000, past_mm=25)
        phone.wait_for_function(FAR_TO_GO, timeout=PATIENCE_MS)  # the card shows itself
        expect(phone.locator(f"{CARD} .order-way")).to_have_text("forward")
        _picture(phone, "arriving")

        state = phone.locator(f"{CARD} [data-state=stop]")
        state.wait_for(timeout=PATIENCE_MS)
        _tell(client, type="brake")
        _picture(phone, "stop")

        good = phone.locator(f"{CARD} [data-state=good]")
        for _ in range(8):  # as told, to and fro, until it is enough
            try:
                good.wait_for(timeout=6_000)
                break
            except NotYetError:
                guidance = client.get("guidance").json()
                ways = {s["direction"]: s["distance_mm"] for s in guidance["steps"]}
                forward = ways.get("forward", 0) - ways.get("back", 0)
                _picture(phone, "correcting")
                _tell(client, type="drive_on", forward_mm=forward)
        expect(phone.locator(f"{CARD} .order-word")).to_have_text("Stop here")
        _picture(phone, "good")
        expect(phone.locator(f"{CARD} [aria-live=polite]")).to_contain_text("Stop here")

        truth = client.get("simulation/car").json()
        seen = client.get("guidance").json()["car"]
        assert abs(seen["x_mm"] - truth["x_mm"]) < 1.5
        assert abs(seen["z_mm"] - truth["z_mm"]) < 1.5


def test_the_page_s_own_pedals_drive_the_simulated_car(phone: Page, server: ServerProcess) -> None:
    server.let_in(phone.context)
    phone.goto(server.url)
    card = phone.locator(CARD)
    card.wait_for(timeout=PATIENCE_MS)
    toggle = card.get_by_role("button", name="Parking guidance")
    if toggle.count():
        toggle.tap()
    card.get_by_role("button", name="Drive in").tap()
    card.locator(".car-above").wait_for(timeout=PATIENCE_MS)
    card.get_by_role("button", name="Brake").tap()
    card.get_by_role("button", name="Leave").tap()
    expect(card.locator(".car-above")).to_have_count(0, timeout=PATIENCE_MS)
    with server.rest() as client:
        assert client.get("simulation/car").json()["z_mm"] > 800


def test_every_state_is_accessible_and_to_be_read_at_a_glance(
    phone: Page, stage: Stage, address: str
) -> None:
    for name, guidance in SCENES.items():
        stage.live = LIVE["ready"].model_copy(update={"guidance": guidance})
        phone.goto(address)
        order = phone.locator(f"{CARD} .order")
        order.wait_for()
        assert violations_by_day_and_night(phone) == [], name
        for button in phone.locator(f"{CARD} button").all():
            box = button.bounding_box()
            assert box is not None
            assert min(box["width"], box["height"]) >= MIN_TARGET_PX
        assert phone.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
        seen = order.bounding_box()
        assert seen is not None
        assert seen["y"] >= 0
        if guidance.state != "paused":
            drawing = phone.locator(f"{CARD} .top-view").bounding_box()
            assert drawing is not None
            assert drawing["y"] + drawing["height"] <= PHONE["height"], "no scrolling while driving"
