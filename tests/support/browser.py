"""A browser with software graphics, for tests of pages that draw in 3D."""

from __future__ import annotations

from collections.abc import AsyncIterator

import pytest_asyncio
from playwright.async_api import Browser, async_playwright

from tests.support.chromium import EXECUTABLE, SOFTWARE_3D, require_chromium


@pytest_asyncio.fixture
async def chromium() -> AsyncIterator[Browser]:
    """A headless browser; the test is skipped where the Debian package chromium is missing."""
    require_chromium()
    async with async_playwright() as playwright:
        browser = await playwright.chromium.launch(executable_path=EXECUTABLE, args=SOFTWARE_3D)
        try:
            yield browser
        finally:
            await browser.close()
