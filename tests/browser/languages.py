"""The languages of the pages, and what runs over the edge of a screen."""

from __future__ import annotations

from collections.abc import Mapping

from playwright.sync_api import Page

LOCALES: Mapping[str, str] = {"en": "en-GB", "fr": "fr-FR", "de": "de-DE", "it": "it-IT"}
"""Languages, each with what a browser asks for."""

_RUNS_OVER = """() => {
  const found = [];
  const wide = document.documentElement.clientWidth;
  for (const each of document.querySelectorAll('body *')) {
    if (each.closest('svg, .unseen, select') || each.checkVisibility() === false) continue;
    const box = each.getBoundingClientRect();
    const name = `${each.tagName}.${each.className}: ${each.textContent.slice(0, 60)}`;
    if (box.width > 0 && (box.right > wide + 0.5 || box.left < -0.5)) found.push(`outside ${name}`);
    if (each.matches('button, a, summary, h1, h2, dt, dd, label') &&
        each.scrollWidth > each.clientWidth + 1 && each.clientWidth > 0) {
      found.push(`too tight ${name}`);
    }
  }
  return found;
}"""


def overflows(page: Page) -> list[str]:
    """Elements that stand out of the screen, or whose words do not fit into them."""
    found: list[str] = page.evaluate(_RUNS_OVER)
    return found
