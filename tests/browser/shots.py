"""Pictures of the pages in every state: ``python -m tests.browser.shots FOLDER [STATE...]``.

The home page is shown in four languages, the technician's page in English.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from itertools import product
from pathlib import Path
from typing import Literal

from server.schema.live import Live
from tests.browser.chromium import DESKTOP, PHONE, chromium
from tests.browser.guidance_scenes import SCENES as GUIDANCE
from tests.browser.languages import LOCALES
from tests.browser.scenes import SCENES
from tests.browser.stage import Stage, serve

SIZES = {"phone": PHONE, "desktop": DESKTOP}
SCHEMES: tuple[Literal["light", "dark"], ...] = ("light", "dark")
STATES: Mapping[str, Live] = {
    **SCENES,
    **{
        f"guidance-{name}": SCENES["ready"].model_copy(update={"guidance": guidance})
        for name, guidance in GUIDANCE.items()
    },
}


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
            for name in names or STATES:
                stage.live = STATES[name]
                for which in ("home", "technician") if language == "en" else ("home",):
                    page.goto(address + ("/technician" if which == "technician" else "/"))
                    page.locator(".link[data-link=live]").wait_for()
                    file = f"{which}-{name}-{language}-{size}-{scheme}.png"
                    page.screenshot(path=Path(folder) / file)
            page.close()


if __name__ == "__main__":
    main()
