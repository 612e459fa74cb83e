"""Pictures of the pages: ``python -m tests.browser.shots FOLDER [NAME...]``.

Writes FOLDER/<page>-<name>-<size>-<scheme>-<language>.png, by day and by night, in four languages.
NAME is a part of a picture's name: ``kiosk``, ``home-charging``, ``guide-``, ``phone-dark-en``.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from itertools import product
from pathlib import Path
from typing import Literal

from playwright.sync_api import Browser, Page, ViewportSize

from tests.browser.chromium import DESKTOP, PHONE, chromium
from tests.browser.languages import LOCALES
from tests.browser.shots import home, kiosk, technician
from tests.browser.shots.shot import PATHS, Room, Shot, until_live
from tests.browser.stage import Stage, serve

SETTLES_MS = 300
"""For fonts and pictures; nothing on the pages waits for it."""
SCHEMES: tuple[Literal["light", "dark"], ...] = ("light", "dark")
_PERSON: Mapping[str, ViewportSize] = {
    "phone": {"width": PHONE["width"], "height": PHONE["height"]},
    "desktop": {"width": DESKTOP["width"], "height": DESKTOP["height"]},
}
SIZES: Mapping[Room, Mapping[str, ViewportSize]] = {
    "home": _PERSON,
    "technician": _PERSON,
    "kiosk": {"7inch": {"width": 800, "height": 480}, "10inch": {"width": 1024, "height": 600}},
}


Kind = tuple[str, Literal["light", "dark"], str]
"""Size, colour scheme, language."""


def main() -> None:
    """Takes all that have one of the names, or all."""
    folder, *parts = sys.argv[1:]
    Path(folder).mkdir(parents=True, exist_ok=True)
    wanted = list(_wanted(parts))
    if not wanted:
        sys.exit(f"No picture's name has a part like {' or '.join(parts)}.")
    stage = Stage()
    with serve(stage) as address, chromium() as browser:
        for number, (shot, file, page) in enumerate(_staged(browser, stage, wanted), 1):
            page.goto(address + PATHS[shot.room])
            (shot.opened or until_live)(page)
            page.wait_for_timeout(SETTLES_MS)
            page.screenshot(path=Path(folder) / f"{file}.png", full_page=shot.whole)
            if sys.stdout.isatty():
                print(f"\r{number} of {len(wanted)}", end="", flush=True)
    print(f"\n{len(wanted)} pictures are in {folder}.")


def _wanted(parts: list[str]) -> Iterator[tuple[Shot, Kind, str]]:
    """What is to be taken, and the files' names."""
    for shot in (*home.shots(), *technician.shots(), *kiosk.shots()):
        languages = ["en"] if shot.english_only else list(LOCALES)
        for size, scheme, language in product(SIZES[shot.room], SCHEMES, languages):
            file = f"{shot.room}-{shot.name}-{size}-{scheme}-{language}"
            if not parts or any(part in file for part in parts):
                yield shot, (size, scheme, language), file


def _staged(
    browser: Browser, stage: Stage, wanted: list[tuple[Shot, Kind, str]]
) -> Iterator[tuple[Shot, str, Page]]:
    """Each with a browser that was never here before."""
    for shot, (size, scheme, language), file in wanted:
        stage.live, stage.session = shot.live, shot.session
        context = browser.new_context(
            viewport=SIZES[shot.room][size],
            color_scheme=scheme,
            locale=LOCALES[language],
            reduced_motion="reduce",
            has_touch=size != "desktop",
        )
        yield shot, file, context.new_page()
        context.close()


if __name__ == "__main__":
    main()
