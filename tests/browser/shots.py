"""Pictures of the pages in every state: ``python -m tests.browser.shots FOLDER [STATE...]``."""

from __future__ import annotations

import sys
from itertools import product
from pathlib import Path
from typing import Literal

from tests.browser.chromium import DESKTOP, PHONE, chromium
from tests.browser.scenes import SCENES
from tests.browser.stage import Stage, serve

SIZES = {"phone": PHONE, "desktop": DESKTOP}
PAGES = {"home": "/", "technician": "/technician"}
SCHEMES: tuple[Literal["light", "dark"], ...] = ("light", "dark")


def main() -> None:
    """Writes FOLDER/<page>-<state>-<size>-<scheme>.png."""
    folder, *names = sys.argv[1:]
    stage = Stage()
    with serve(stage) as address, chromium() as browser:
        for size, viewport in SIZES.items():
            for scheme in SCHEMES:
                page = browser.new_page(
                    viewport={"width": viewport["width"], "height": viewport["height"]},
                    color_scheme=scheme,
                    device_scale_factor=1,
                    reduced_motion="reduce",
                )
                for (which, path), name in product(PAGES.items(), names or SCENES):
                    stage.live = SCENES[name]
                    page.goto(address + path)
                    page.locator(".link[data-link=live]").wait_for()
                    page.screenshot(path=Path(folder) / f"{which}-{name}-{size}-{scheme}.png")
                page.close()


if __name__ == "__main__":
    main()
