"""A badly built robot becomes a good one through the page: measured, used, and taken back.

Its camera is calibrated with the board in a simulated hand.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, BrowserContext, Page, expect

from tests.browser.chromium import PHONE
from tests.support.process import ServerProcess, serving

SPEED = "25"
SEED = "5"
BADLY_BUILT = """
[simulation.parameters.build]
length_std_mm = 1.5
rail_skew_std_rad = 0.00436
belt_scale_std = 0.0025
mount_angle_std_rad = 0.026
"""
"""What a drill and a printer leave; the camera's own numbers and its place are known."""
ROUTINE_TIMEOUT_MS = 120_000
JOB_TIMEOUT_MS = 60_000
LOOK_TIMEOUT_MS = 30_000
PICTURES = 3
SOME_PLACE = re.compile(r"Place \d+ of 25")
GOOD_MM, BADLY_MM = 0.06, 0.5


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServerProcess]:
    """The real server with a robot that fits its drawing badly."""
    file: Path = tmp_path_factory.mktemp("robot") / "plugpilot.toml"
    file.write_text(BADLY_BUILT, encoding="utf-8")
    with serving("--config", str(file), "--speed", SPEED, "--seed", SEED) as running:
        yield running


@pytest.fixture
def phone(browser: Browser, server: ServerProcess) -> Iterator[BrowserContext]:
    """A technician's phone."""
    context = browser.new_context(
        viewport={"width": PHONE["width"], "height": PHONE["height"]}, has_touch=True
    )
    server.let_in(context)
    yield context
    context.close()


def test_a_badly_built_robot_is_measured_used_and_plugs_in(
    phone: BrowserContext, server: ServerProcess
) -> None:
    page = phone.new_page()
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(f"{server.url}/technician")
    _open(page)

    page.get_by_role("button", name="Measure the robot").tap()
    page.get_by_role("button", name="Begin to measure").tap()
    expect(page.get_by_text(SOME_PLACE)).to_be_visible(timeout=ROUTINE_TIMEOUT_MS)
    page.reload()
    expect(page.get_by_text("of 25")).to_be_visible()  # it opens by itself

    expect(page.get_by_text("The robot has been measured")).to_be_visible(
        timeout=ROUTINE_TIMEOUT_MS
    )
    expect(page.locator(".plot .arrow").nth(15)).to_be_attached()
    assert _in_force(server) is None, "nothing is used before somebody wants it"
    page.get_by_role("button", name="Use it", exact=True).tap()
    expect(page.get_by_text("It is in use now.")).to_be_visible()

    used = _in_force(server)
    assert used is not None
    assert used["error"] < GOOD_MM < BADLY_MM < used["error_in_use"]

    page.reload()
    _open(page)
    expect(page.get_by_text("It is in use now.")).to_be_visible()
    page.get_by_role("button", name="Close").tap()
    expect(page.get_by_role("button", name="Roll back: Robot")).to_be_enabled()

    page.goto(server.url)
    page.get_by_role("button", name="Charge", exact=True).tap()
    expect(page.get_by_role("heading", level=1)).to_have_text(
        "Your car is charging", timeout=JOB_TIMEOUT_MS
    )
    page.goto(f"{server.url}/technician")
    _open(page)
    page.get_by_role("button", name="Roll back: Robot").tap()
    expect(page.locator(".calibration .panel-trouble")).to_be_visible()
    assert _in_force(server) == used, "not while a job uses the robot"

    page.goto(server.url)
    page.get_by_role("button", name="Stop and unplug").tap()
    page.get_by_role("button", name="Charge", exact=True).wait_for(timeout=JOB_TIMEOUT_MS)
    page.goto(f"{server.url}/technician")
    _open(page)
    page.get_by_role("button", name="Roll back: Robot").tap()
    expect(page.locator(".calibration-list").first).to_contain_text("Robot as drawn")
    assert _in_force(server) is None
    assert errors == []


def test_the_board_is_held_as_the_page_says(phone: BrowserContext, server: ServerProcess) -> None:
    page = phone.new_page()
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(f"{server.url}/technician")
    _open(page)
    begin, earlier = (
        page.get_by_role("button", name=name) for name in ("Calibrate the camera", "Discard")
    )
    begin.or_(earlier).wait_for()
    if earlier.is_visible():
        earlier.tap()  # what the last routine has found
    begin.tap()
    page.get_by_role("button", name="Begin to look").tap()
    expect(page.get_by_text("No board in sight")).to_be_visible(timeout=LOOK_TIMEOUT_MS)
    for taken in range(PICTURES):
        expect(page.get_by_text(re.compile(f"Picture {taken} of"))).to_be_visible()
        page.get_by_role("button", name="Do what it says").tap()
        expect(page.get_by_text(re.compile(f"Picture {taken + 1} of"))).to_be_visible(
            timeout=LOOK_TIMEOUT_MS
        )
        expect(page.locator(".board-overlay circle").nth(11)).to_be_attached()
    expect(page.locator(".cell:not(.empty)").nth(10)).to_be_attached()
    page.get_by_role("button", name="Put the board away").tap()
    expect(page.get_by_text("No board in sight")).to_be_visible(timeout=LOOK_TIMEOUT_MS)
    page.get_by_role("button", name="End it").tap()
    expect(page.get_by_text("Ended before it was done")).to_be_visible()
    assert errors == []


def _open(page: Page) -> None:
    panel = page.locator("details.panel").first
    panel.evaluate("panel => { panel.open = true; }")
    page.locator(".calibration :is(.calibration-starts, .calibration-actions)").first.wait_for()


def _in_force(server: ServerProcess) -> dict[str, float] | None:
    with server.rest() as client:
        found: dict[str, float] | None = client.get("calibrations/now").json()["in_force"]["robot"]
    return found
