"""Pictures of the pages in every state: ``python -m tests.browser.shots FOLDER [STATE...]``.

The home page and what is opened on the technician's page are shown in four languages, the other
states of the technician's page in English.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from functools import partial
from itertools import product
from pathlib import Path
from typing import Literal

from playwright.sync_api import Page

from server.schema.live import Live
from tests.browser.bench_scenes import OPENED as BENCH_OPENED
from tests.browser.chromium import DESKTOP, PHONE, chromium
from tests.browser.control_scenes import SCENES as CONTROL
from tests.browser.guidance_scenes import SCENES as GUIDANCE
from tests.browser.languages import LOCALES
from tests.browser.scenes import SCENES
from tests.browser.stage import OWNER, STRANGER, Stage, serve

SETTLES_MS = 400
SIZES = {"phone": PHONE, "desktop": DESKTOP}
SCHEMES: tuple[Literal["light", "dark"], ...] = ("light", "dark")
STATES: Mapping[str, Live] = {
    **SCENES,
    **CONTROL,
    **{
        f"guidance-{name}": SCENES["ready"].model_copy(update={"guidance": guidance})
        for name, guidance in GUIDANCE.items()
    },
}


def _plan(page: Page) -> None:
    page.locator(".hero-action .button.text").click()
    page.locator("dialog").wait_for()


def _question(page: Page) -> None:
    page.locator(".hero-action .button.primary").click()
    page.locator("dialog").wait_for()


def _history(page: Page) -> None:
    page.locator(".history summary").click()
    page.locator(".past button").wait_for()


def _replay(page: Page) -> None:
    _history(page)
    page.locator(".past button").click()
    page.locator(".player-bar").wait_for()


def _robot(page: Page) -> None:
    page.locator(".robot summary").click()
    page.locator(".robot dl").scroll_into_view_if_needed()


OPENED: Mapping[str, tuple[str, Callable[[Page], None]]] = {
    "plan": ("ready", _plan),
    "release": ("stopped", _question),
    "plug-question": ("unknown", _question),
    "history": ("ready", _history),
    "replay": ("ready", _replay),
    "robot": ("charging", _robot),
}
"""What is opened on the home page, each with the state it is opened in."""


def main() -> None:
    """Writes FOLDER/<page>-<state>-<language>-<size>-<scheme>.png."""
    folder, *names = sys.argv[1:]
    stage = Stage()
    with serve(stage) as address, chromium() as browser:
        for size, scheme, language in product(SIZES, SCHEMES, LOCALES):
            page = browser.new_page(
                viewport={"width": SIZES[size]["width"], "height": SIZES[size]["height"]},
                color_scheme=scheme,
                locale=LOCALES[language],
                device_scale_factor=1,
                reduced_motion="reduce",
            )
            shoot = partial(_shoot, page, Path(folder), f"{language}-{size}-{scheme}")
            for name in [name for name in names or BENCH_OPENED if name in BENCH_OPENED]:
                _shoot_bench(page, stage, address, name, shoot)
            for name in [name for name in names or (*STATES, *OPENED) if name not in BENCH_OPENED]:
                state, opened = OPENED.get(name, (name, None))
                stage.live = STATES[state]
                page.goto(address)
                page.locator(".link[data-link=live]").wait_for()
                if opened is not None:
                    opened(page)
                shoot(f"home-{name}")
                if language == "en" and opened is None:
                    page.goto(f"{address}/technician")
                    page.locator(".link[data-link=live]").wait_for()
                    shoot(f"technician-{name}")
            if not names:
                _shoot_without_a_robot(page, stage, address, shoot)
            page.close()


def _shoot_bench(
    page: Page, stage: Stage, address: str, name: str, shoot: Callable[[str], None]
) -> None:
    """Something that is opened on the technician's page, from its top."""
    stage.live, opened = BENCH_OPENED[name]
    page.goto(f"{address}/technician")
    page.evaluate("() => { localStorage.clear(); sessionStorage.clear(); }")  # nothing read before
    page.reload()
    page.locator(".link[data-link=live]").wait_for()
    opened(page)
    page.locator("details.panel[open]").evaluate("panel => panel.scrollIntoView()")
    page.wait_for_timeout(SETTLES_MS)
    shoot(f"technician-{name}")


def _shoot_without_a_robot(
    page: Page, stage: Stage, address: str, shoot: Callable[[str], None]
) -> None:
    """The way in, and the page that cannot reach its robot."""
    stage.session = STRANGER
    page.goto(address)
    page.locator(".door-form").wait_for()
    shoot("pairing")
    stage.session = OWNER
    page.route("**/api/**", lambda route: route.abort())
    page.goto(address)
    page.locator(".away").wait_for()
    shoot("away")


def _shoot(page: Page, folder: Path, kind: str, name: str) -> None:
    page.screenshot(path=folder / f"{name}-{kind}.png")


if __name__ == "__main__":
    main()
