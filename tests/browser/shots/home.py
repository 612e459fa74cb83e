"""The home page: its states, and what can be opened on it."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from playwright.sync_api import Page

from tests.browser.control_scenes import SCENES as CONTROL
from tests.browser.guidance_scenes import SCENES as GUIDANCE
from tests.browser.guide_scenes import SCENES as GUIDES
from tests.browser.scenes import SCENES
from tests.browser.shots.shot import Shot, click, until_live
from tests.browser.stage import STRANGER

TABS = ("people", "keys", "trail", "own")
"""web/src/access/menu.tsx"""


def _replay(page: Page) -> None:
    click(".history summary", ".past button")(page)
    click(".past button", ".player-bar")(page)


def _menu(tab: str) -> Callable[[Page], None]:
    def opened(page: Page) -> None:
        click(".menu-button", ".tabs")(page)
        page.locator(".tabs button").nth(TABS.index(tab)).click()
        page.wait_for_load_state("networkidle")

    return opened


def _door(page: Page) -> None:
    page.locator(".door-form").wait_for()


def _away(page: Page) -> None:
    until_live(page)
    page.route("**/api/**", lambda route: route.abort())
    page.reload()
    page.locator(".away").wait_for()
    page.unroute("**/api/**")


QUESTION = click(".hero-action .button.primary")

OPENED: dict[str, tuple[str, Callable[[Page], None]]] = {
    "charge": ("ready", QUESTION),
    "plan": ("ready", click(".hero-action .button.text")),
    "release": ("stopped", QUESTION),
    "plug-question": ("unknown", QUESTION),
    **{f"menu-{tab}": ("ready", _menu(tab)) for tab in TABS},
    "menu-moving": ("aligning", _menu("own")),
}
"""Dialogs, each with the state that it is opened in."""

UNFOLDED: dict[str, tuple[str, Callable[[Page], None]]] = {
    "history": ("ready", click(".history summary", ".past button")),
    "replay": ("ready", _replay),
    "robot": ("charging", click(".robot summary", ".robot dl")),
    "away": ("ready", _away),
}
"""What makes the page longer, each with the state that it is opened in."""


def shots() -> Iterator[Shot]:
    """All of them."""
    for name, live in {**SCENES, **CONTROL}.items():
        yield Shot("home", name, live)
    for name, guidance in GUIDANCE.items():
        live = SCENES["ready"].model_copy(update={"guidance": guidance})
        yield Shot("home", f"guidance-{name}", live)
    for name, live in GUIDES.items():
        yield Shot("home", f"guide-{name}", live, click(".guide-button"), whole=False)
    for name, (scene, opened) in OPENED.items():
        yield Shot("home", name, SCENES[scene], opened, whole=False)
    for name, (scene, opened) in UNFOLDED.items():
        yield Shot("home", name, SCENES[scene], opened)
    yield Shot("home", "pairing", SCENES["ready"], _door, session=STRANGER)
