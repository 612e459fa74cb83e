"""The technician's page in a real browser against the real server: jogging ends with the hand."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, BrowserContext, Page, expect

from tests.browser.axe import violations
from tests.browser.chromium import DESKTOP, PHONE
from tests.browser.scenes import SCENES
from tests.browser.stage import Stage
from tests.support.process import ServerProcess, serving

MOVED_MM = 1.0
COAST_MM = 2.0
"""A joint at 5 mm/s with 250 ms of silence and a ramp goes no further."""
MIN_TARGET_PX = 44

UP = re.compile(r"^Up\b")
RHO1 = ".values tbody tr:first-child td:nth-of-type(2)"
HOLDS = 8
"""On a busy machine the page's sign of life comes late, and the robot rightly stops on its way."""
THERE_OR_LET_GO = """() => {
    const button = document.querySelector(".target-hold");
    return button === null || (button.dataset.held === "false" && !button.disabled);
}"""
BEYOND = """([cell, limit, sign]) =>
    sign * (parseFloat(document.querySelector(cell).textContent) - limit) > 0"""


QUICKLY_HOMED = """
[simulation.parameters.homing]
locate_speed_mm_s = 10
rail_speed_mm_s = 200
acceleration_mm_s2 = 1000
"""


@pytest.fixture(scope="module")
def server(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServerProcess]:
    """The real server on the simulator, at the pace of a real robot, made ready on the page."""
    config = tmp_path_factory.mktemp("technician") / "plugpilot.toml"
    config.write_text(QUICKLY_HOMED, encoding="utf-8")
    with serving("--config", str(config), "--speed", "1", "--seed", "3") as running:
        page = browser.new_page()
        running.let_in(page.context)
        page.goto(f"{running.url}/technician")
        page.get_by_role("button", name="Switch drives on").click()
        page.get_by_role("button", name="Find position").click()
        expect(page.get_by_role("button", name=UP)).to_be_enabled(timeout=60_000)
        page.close()
        yield running


@pytest.fixture
def context(browser: Browser) -> Iterator[BrowserContext]:
    """A laptop."""
    context = browser.new_context(viewport={"width": DESKTOP["width"], "height": DESKTOP["height"]})
    yield context
    context.close()


@pytest.fixture
def bench(context: BrowserContext, server: ServerProcess) -> Iterator[Page]:
    """The page, live; it may not meet a single script error."""
    server.let_in(context)
    page = context.new_page()
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(f"{server.url}/technician")
    expect(page.get_by_role("button", name=UP)).to_be_enabled()
    yield page
    assert errors == []


def test_the_robot_moves_while_the_button_is_held_and_no_longer(
    bench: Page, server: ServerProcess
) -> None:
    began_mm = _rho1_mm(server)
    _hold(bench, "On along the rail")
    _moves_beyond(bench, began_mm + MOVED_MM)
    bench.mouse.up()
    _comes_to_rest_near(bench, server, _rho1_mm(server))


def test_a_page_that_is_closed_lets_go(
    bench: Page, context: BrowserContext, server: ServerProcess
) -> None:
    second = context.new_page()
    second.goto(f"{server.url}/technician")
    expect(second.get_by_role("button", name=UP)).to_be_enabled()
    began_mm = _rho1_mm(server)
    _hold(second, "Back along the rail")
    _moves_beyond(bench, began_mm - MOVED_MM, sign=-1)
    second.close()
    _comes_to_rest_near(bench, server, _rho1_mm(server))


def test_a_page_that_loses_the_focus_lets_go(bench: Page, server: ServerProcess) -> None:
    began_mm = _rho1_mm(server)
    _hold(bench, "On along the rail")
    _moves_beyond(bench, began_mm + MOVED_MM)
    bench.evaluate("dispatchEvent(new Event('blur'))")
    _comes_to_rest_near(bench, server, _rho1_mm(server))
    bench.mouse.up()


def test_a_step_moves_one_joint_by_its_distance(bench: Page, server: ServerProcess) -> None:
    bench.get_by_role("button", name="Joints").click()
    bench.get_by_role("button", name="1", exact=True).first.click()
    began_mm = _rho1_mm(server)
    bench.get_by_role("button", name="Left carriage on").click()
    _moves_beyond(bench, began_mm + 0.98)
    expect(bench.get_by_role("button", name="Left carriage on")).to_be_enabled()
    assert abs(_rho1_mm(server) - began_mm - 1.0) < 0.02


def test_the_space_bar_stops_and_the_stop_is_released_here(
    bench: Page, server: ServerProcess
) -> None:
    began_mm = _rho1_mm(server)
    _hold(bench, "Back along the rail")
    _moves_beyond(bench, began_mm - MOVED_MM, sign=-1)
    bench.keyboard.press("Space")
    bench.get_by_role("button", name="Release the stop").click()
    bench.mouse.up()
    bench.get_by_role("dialog").get_by_role("button", name="Yes, release").click()
    expect(bench.get_by_role("button", name=UP)).to_be_enabled()


def test_a_place_is_shown_first_and_reached_only_while_the_button_is_held(
    bench: Page, server: ServerProcess
) -> None:
    tip = _tip(server)
    bench.route("**/twin/**", lambda route: route.abort())  # software 3D would take the machine
    bench.locator("summary", has_text="Twin").click()
    bench.get_by_label("x, mm").fill(f"{tip['x_mm'] + 6:.1f}")
    bench.get_by_label("y, mm").fill(f"{tip['y_mm'] + 3:.1f}")
    bench.get_by_role("button", name="Show the way").click()
    hold = bench.get_by_role("button", name="Hold to move there")
    expect(hold).to_be_enabled()
    assert _tip(server) == tip, "a preview moves nothing"
    hold.hover()
    bench.mouse.down()
    expect(bench.locator(".robot-box .list dd").first).to_have_text("moving")
    bench.mouse.up()
    expect(hold).to_be_enabled()  # what is left of the way was asked for
    between = _tip(server)
    assert tip["x_mm"] < between["x_mm"] < tip["x_mm"] + 5
    for _ in range(HOLDS):
        hold.hover()
        bench.mouse.down()
        expect(bench.locator(".robot-box .list dd").first).to_have_text("moving")
        bench.wait_for_function(THERE_OR_LET_GO)
        bench.mouse.up()
        if bench.get_by_text("The plug is there.").is_visible():
            break
        expect(hold).to_be_enabled()
    assert abs(_tip(server)["x_mm"] - tip["x_mm"] - 6) < 0.2
    assert abs(_tip(server)["y_mm"] - tip["y_mm"] - 3) < 0.2


def test_the_camera_shows_the_label_and_its_pose(bench: Page) -> None:
    bench.locator("summary", has_text="Camera").click()
    expect(bench.locator(".camera-overlay[data-trusted=true] .outline")).to_be_visible(
        timeout=20_000
    )
    expect(bench.get_by_text("passed every check")).to_be_visible()
    assert violations(bench) == []


def test_the_console_shows_what_a_step_sends(bench: Page) -> None:
    bench.locator("summary", has_text="Protocol console").click()
    bench.get_by_text("Listening.").wait_for()
    bench.get_by_role("button", name="0.1", exact=True).click()
    bench.get_by_role("button", name=re.compile(r"^Down,")).click()
    bench.get_by_label("Search").fill("segments")
    expect(bench.locator(".console-frames [data-direction=to_board]").first).to_be_visible()
    assert violations(bench) == []


@pytest.mark.parametrize("scene", ["ready", "jog", "emergency", "fault", "off", "offline"])
def test_every_state_is_accessible_and_large_enough_to_touch(
    browser: Browser, address: str, stage: Stage, scene: str
) -> None:
    stage.live = SCENES[scene]
    page = browser.new_page(viewport={"width": PHONE["width"], "height": PHONE["height"]})
    page.goto(f"{address}/technician")
    page.locator(".link[data-link=live]").wait_for()
    page.locator(".uplot").first.wait_for()
    assert violations(page) == []
    for target in page.get_by_role("button").all():
        box = target.bounding_box()
        assert box is not None
        assert min(box["width"], box["height"]) >= MIN_TARGET_PX, target.inner_text()
    assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
    page.close()


def _hold(page: Page, name: str) -> None:
    page.get_by_role("button", name=name).hover()
    page.mouse.down()


def _rho1_mm(server: ServerProcess) -> float:
    with server.rest() as client:
        robot = client.get("robot").json()
    return float(robot["measured"]["joints"]["rho1_mm"])


def _tip(server: ServerProcess) -> dict[str, float]:
    with server.rest() as client:
        robot = client.get("robot").json()
    tip: dict[str, float] = robot["commanded"]["tip"]
    return tip


def _moves_beyond(page: Page, limit_mm: float, *, sign: int = 1) -> None:
    page.wait_for_function(BEYOND, arg=[RHO1, limit_mm, sign])


def _comes_to_rest_near(page: Page, server: ServerProcess, place_mm: float) -> None:
    expect(page.locator(".robot-box .list dd").first).to_have_text("ready")
    assert abs(_rho1_mm(server) - place_mm) < COAST_MM
