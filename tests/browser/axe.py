"""The rules of accessibility that a page breaks, found by axe."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page

AXE = Path(__file__).resolve().parents[2] / "web/node_modules/axe-core/axe.min.js"


ABOUT_COLOURS = ["color-contrast", "link-in-text-block"]
"""All that the night can change: it brings other colours and nothing else."""


def violations(page: Page) -> list[str]:
    """Rules of axe that the page breaks, with the elements."""
    if not AXE.exists():
        pytest.skip("needs axe-core: run `npm ci` in web/")
    page.evaluate(AXE.read_text(encoding="utf-8"))
    return _broken(page, {})


def violations_by_day_and_night(page: Page) -> list[str]:
    """The same of a page that stands in the light, and what is hard to see in the dark."""
    by_day = violations(page)
    page.emulate_media(color_scheme="dark")
    by_night = _broken(page, {"runOnly": ABOUT_COLOURS})
    page.emulate_media(color_scheme="light")
    return by_day + [f"by night: {each}" for each in by_night]


def _broken(page: Page, options: dict[str, Any]) -> list[str]:
    found: list[dict[str, Any]] = page.evaluate(
        "(options) => axe.run(options).then((r) => r.violations)", options
    )
    return [f"{each['id']}: {[node['html'] for node in each['nodes']]}" for each in found]
