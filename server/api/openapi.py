"""Prints the OpenAPI document, stable and sorted: ``python -m server.api.openapi``.

Nothing is started for that: the application is made, but its lifespan never begins.
"""

from __future__ import annotations

import json
import sys
from contextlib import AbstractAsyncContextManager

from server.api.app import create_app
from server.services import Services

CONTRACT_VERSION = "1"


def document() -> str:
    """The document as it is checked in."""
    content = create_app(_never_started).openapi()
    content["info"]["version"] = CONTRACT_VERSION
    return json.dumps(content, indent=2, sort_keys=True, ensure_ascii=False) + "\n"


def _never_started() -> AbstractAsyncContextManager[Services]:
    raise AssertionError("the application that only describes itself was started")


if __name__ == "__main__":
    sys.stdout.write(document())
