"""The machine's Chromium: where it is and how it is started, quiet and offline."""

from __future__ import annotations

from pathlib import Path

import pytest

EXECUTABLE = "/usr/bin/chromium"

QUIET = [
    "--no-sandbox",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
FLAT = [*QUIET, "--disable-gpu"]
"""For pages without 3D."""

SOFTWARE_3D = [
    *QUIET,
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
]
"""For pages that draw in 3D, on a machine without graphics."""


def require_chromium() -> None:
    """Skip the test where the Debian package is missing."""
    if not Path(EXECUTABLE).exists():
        pytest.skip("install the Debian package chromium")
