"""Pictures of the home page in every state: ``python -m tests.browser.shots FOLDER [STATE...]``."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Literal

from tests.browser.chromium import DESKTOP, PHONE, chromium
from tests.browser.scenes import SCENES
from tests.browser.stage import Stage, serve

SIZES = {"phone": PHONE, "desktop": DESKTOP}
SCHEMES: tuple[Literal["light", "dark"], ...] = ("light", "dark")


def main() -> None:
    """Writes FOLDER/web-<state>-<size>-<scheme>.png."""
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
                for name in names or SCENES:
                    stage.live = SCENES[name]
                    page.goto(address)
                    page.locator(".link[data-link=live]").wait_for()
                    page.screenshot(path=Path(folder) / f"web-{name}-{size}-{scheme}.png")
                page.close()


if __name__ == "__main__":
    main()
