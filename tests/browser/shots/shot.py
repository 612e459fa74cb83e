"""One picture of a page: what it shows, and what is opened on it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from playwright.sync_api import Page

from server.schema.access import AccessSession
from server.schema.live import Live
from tests.browser.stage import OWNER

Room = Literal["home", "technician", "kiosk"]

PATHS: dict[Room, str] = {"home": "/", "technician": "/technician", "kiosk": "/kiosk"}


@dataclass(frozen=True)
class Shot:
    """A page in a state.

    Attributes:
        room: The page.
        name: What the file is called after the page's name.
        live: The state that the page is sent.
        opened: Opens what is to be seen, once the page is there; leave out for the page itself.
        session: Who looks.
        whole: The page from top to bottom, else what fits on the screen.
        english_only: Its words are seen in another shot already.
    """

    room: Room
    name: str
    live: Live
    opened: Callable[[Page], None] | None = None
    session: AccessSession = OWNER
    whole: bool = True
    english_only: bool = False


def until_live(page: Page) -> None:
    """Wait until the page shows what it is sent."""
    page.locator(".link[data-link=live]").wait_for()


def click(selector: str, then: str = "dialog") -> Callable[[Page], None]:
    """Opens something by a click, and waits until it is there."""

    def opened(page: Page) -> None:
        until_live(page)
        page.locator(selector).first.click()
        page.locator(then).first.wait_for()

    return opened
