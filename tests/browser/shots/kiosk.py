"""The robot's own touch screen: its states, its rest, and the way in."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from playwright.sync_api import Page

from tests.browser.control_scenes import SCENES as CONTROL
from tests.browser.scenes import SCENES
from tests.browser.shots.shot import Shot, click, until_live
from tests.browser.stage import ON_THE_ROBOT, UNOWNED

REST_MS = 61_000
"""A little more than web/src/kiosk/resting.ts waits."""
OPENED: dict[str, tuple[str, Callable[[Page], None]]] = {
    "charge": ("ready", click(".hero-action .button.primary")),
    "plug-question": ("unknown", click(".hero-action .button.primary")),
    "release": ("emergency", click(".hero-action .button.primary")),
    "guide": ("needs_person", click(".guide-button")),
}


def _rest(page: Page) -> None:
    page.clock.install()
    page.reload()
    until_live(page)
    page.clock.fast_forward(REST_MS)
    page.locator(".rest").wait_for()


def _unpaired(page: Page) -> None:
    page.locator(".kiosk-unpaired").wait_for()


def shots() -> Iterator[Shot]:
    """All of them; nothing lies below the edge of this screen."""
    for name, live in {**SCENES, **CONTROL}.items():
        yield Shot("kiosk", name, live, whole=False)
    ready = SCENES["ready"]
    for name, (scene, opened) in OPENED.items():
        yield Shot("kiosk", name, SCENES[scene], opened, whole=False)
    yield Shot("kiosk", "unpaired", ready, _unpaired, session=ON_THE_ROBOT, whole=False)
    yield Shot("kiosk", "unowned", ready, _unpaired, session=UNOWNED, whole=False)
    yield Shot("kiosk", "rest", ready, _rest, whole=False)
