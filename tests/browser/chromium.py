"""A headless browser and the two sizes every page is looked at."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from playwright.sync_api import Browser, Page, sync_playwright

from tests.support.chromium import EXECUTABLE, FLAT

PHONE = {"width": 390, "height": 844}
DESKTOP = {"width": 1280, "height": 800}


@contextmanager
def chromium(flags: Sequence[str] = FLAT) -> Iterator[Browser]:
    """A headless browser."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=EXECUTABLE, args=list(flags))
        try:
            yield browser
        finally:
            browser.close()


@contextmanager
def phone_page(browser: Browser, **options: Any) -> Iterator[Page]:  # noqa: ANN401 - Playwright's
    """A phone that may not meet a single script error."""
    context = browser.new_context(
        viewport={"width": PHONE["width"], "height": PHONE["height"]}, **options
    )
    page = context.new_page()
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    yield page
    context.close()
    assert errors == []
