"""The technician's page: its states, and its panels, each opened alone."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from playwright.sync_api import Page

from tests.browser.bench_scenes import OPENED
from tests.browser.control_scenes import SCENES as CONTROL
from tests.browser.scenes import SCENES
from tests.browser.shots.shot import Shot, until_live


def _panel(opened: Callable[[Page], None]) -> Callable[[Page], None]:
    def once_there(page: Page) -> None:
        until_live(page)
        opened(page)

    return once_there


def shots() -> Iterator[Shot]:
    """All of them; the state of the robot in words is the home page's, in English here."""
    for name, live in {**SCENES, **CONTROL}.items():
        yield Shot("technician", name, live, english_only=name not in {"ready", "jog"})
    for name, (live, opened) in OPENED.items():
        yield Shot("technician", name, live, _panel(opened))
