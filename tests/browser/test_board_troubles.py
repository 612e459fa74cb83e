"""What a person reads when the motion board is missing, wrong, or has latched a fault."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from drivers.arduino.protocol.messages import Fault
from tests.browser.chromium import PHONE
from tests.support.board_cable import BoardCable, board_cable
from tests.support.fake_board import FakeBoard
from tests.support.process import ServerProcess, serving

CONNECT_MS = 20_000


@contextmanager
def phone_of(browser: Browser, server: ServerProcess) -> Iterator[Page]:
    """A phone that has opened the home page."""
    context = browser.new_context(
        viewport={"width": PHONE["width"], "height": PHONE["height"]}, has_touch=True
    )
    server.let_in(context)
    page = context.new_page()
    page.goto(server.url)
    yield page
    context.close()


def expect_words(page: Page, headline: str, *words: str) -> None:
    """The headline, and words in the text below it."""
    expect(page.get_by_role("heading", level=1)).to_have_text(headline, timeout=CONNECT_MS)
    for word in words:
        expect(page.locator(".hero-text")).to_contain_text(word)


@pytest.fixture(scope="module")
def cable(tmp_path_factory: pytest.TempPathFactory) -> Iterator[BoardCable]:
    with board_cable(tmp_path_factory.mktemp("board")) as cable:
        yield cable


@pytest.fixture(scope="module")
def server(cable: BoardCable) -> Iterator[ServerProcess]:
    """A server that drives the board at the end of the cable."""
    with serving("--driver", "arduino", "--port", str(cable.device)) as running:
        yield running


@pytest.fixture
def phone(browser: Browser, server: ServerProcess) -> Iterator[Page]:
    with phone_of(browser, server) as page:
        yield page


def latch(cable: BoardCable, fault: Fault) -> None:
    def stop(board: FakeBoard) -> None:
        board._latch(fault, release=True)

    cable.change(stop)


def release(page: Page, button: str) -> None:
    page.get_by_role("button", name=button).tap()
    page.get_by_role("button", name="Yes, release").tap()


def test_a_board_at_rest_is_ready_and_the_car_is_said_to_be_simulated(phone: Page) -> None:
    expect_words(phone, "Ready when you are")
    expect(phone.locator(".badge")).to_have_text("Simulated car")
    phone.locator("summary").filter(has_text="Robot").tap()
    expect(phone.locator(".robot")).to_contain_text("Me Auriga")
    expect(phone.locator(".robot")).to_contain_text("camera, charging station")


def test_a_limit_switch_is_named_and_can_be_released(phone: Page, cable: BoardCable) -> None:
    expect_words(phone, "Ready when you are")
    latch(cable, Fault.LIMIT_SWITCH)
    expect_words(
        phone,
        "The robot ran into a limit switch",
        "limit switch opened",
        "the switch or its wire is broken",
    )
    release(phone, "Release the fault")
    expect_words(phone, "Ready when you are")


def test_an_emergency_stop_says_how_to_end_it(phone: Page, cable: BoardCable) -> None:
    expect_words(phone, "Ready when you are")
    latch(cable, Fault.EMERGENCY_STOP)
    expect_words(phone, "Emergency stop", "Everything stands still", "turn it until it springs out")
    release(phone, "Release the stop")
    expect_words(phone, "Ready when you are")


def test_a_pulled_cable_is_told_and_comes_back_by_itself(phone: Page, cable: BoardCable) -> None:
    expect_words(phone, "Ready when you are")
    cable.pull()
    expect_words(phone, "No motion board at its port", str(cable.device), "USB cable")
    cable.change(lambda board: board.restart())  # it lived on the power of the cable
    cable.plug_in()
    expect_words(phone, "Ready when you are")


def test_a_board_that_is_not_there(browser: Browser, tmp_path: Path) -> None:
    device = str(tmp_path / "ttyUSB7")
    with (
        serving("--driver", "arduino", "--port", device) as server,
        phone_of(browser, server) as page,
    ):
        expect_words(page, "No motion board at its port", device, "--port /dev/ttyUSB0")
        with server.rest() as client:
            fault = client.get("robot").json()["fault"]
        assert fault["code"] == "board_not_found"
        # The pages, the pictures and the API are there all the same.
        expect(page.locator(".link")).to_have_attribute("data-link", "live")


def test_the_firmware_of_another_version(browser: Browser, tmp_path: Path) -> None:
    with (
        board_cable(tmp_path, protocol_hash=0x1234ABCD) as cable,
        serving("--driver", "arduino", "--port", str(cable.device)) as server,
        phone_of(browser, server) as page,
    ):
        expect_words(
            page,
            "The motion board has firmware of another version",
            "1.2.3",
            "1234ABCD",
            "plugpilot firmware flash",
        )


def test_something_that_is_no_board(browser: Browser, tmp_path: Path) -> None:
    with board_cable(tmp_path) as cable:
        cable.change(lambda board: setattr(board, "mute", True))
        with (
            serving("--driver", "arduino", "--port", str(cable.device)) as server,
            phone_of(browser, server) as page,
        ):
            expect_words(
                page,
                "Nothing at the port speaks as a motion board does",
                "not that of another device",
            )
