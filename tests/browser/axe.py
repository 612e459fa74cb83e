"""The rules of accessibility that a page breaks, found by axe."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page

AXE = Path(__file__).resolve().parents[2] / "web/node_modules/axe-core/axe.min.js"


def violations(page: Page) -> list[str]:
    """Rules of axe that the page breaks, with the elements."""
    if not AXE.exists():
        pytest.skip("needs axe-core: run `npm ci` in web/")
    page.evaluate(AXE.read_text(encoding="utf-8"))
    found: list[dict[str, Any]] = page.evaluate("() => axe.run().then((r) => r.violations)")
    return [f"{each['id']}: {[node['html'] for node in each['nodes']]}" for each in found]
