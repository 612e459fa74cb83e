"""One browser and one stage for all tests of a module."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, expect

from tests.browser.chromium import chromium
from tests.browser.stage import STATIC_DIR, Stage, serve
from tests.support.chromium import require_chromium

PATIENCE_MS = 20_000
"""Two tests run at once, each with a browser, some with a server, too."""


@pytest.fixture(scope="session", autouse=True)
def _patient() -> None:
    expect.set_options(timeout=PATIENCE_MS)


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """The machine's Chromium."""
    require_chromium()
    with chromium() as running:
        yield running


@pytest.fixture(scope="module")
def stage() -> Stage:
    """What the pages are shown."""
    if not (STATIC_DIR / "index.html").exists():
        pytest.skip("needs the built pages: run `make setup`")
    return Stage()


@pytest.fixture(scope="module")
def address(stage: Stage) -> Iterator[str]:
    """Where the stage is served."""
    with serve(stage) as url:
        yield url
